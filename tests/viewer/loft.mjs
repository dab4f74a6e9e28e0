// SPDX-License-Identifier: MIT
// The program while it runs, and slices for it.
import { spawn } from 'node:child_process';

export class Loft {
  // Resolves when it listens.
  static async start(...words) {
    const loft = new Loft();
    loft.process = spawn(process.env.LOFT, words, { stdio: ['ignore', 'ignore', 'pipe'] });
    loft.ended = new Promise((resolve) => loft.process.once('exit', resolve));
    loft.url = await loft.#listening();
    return loft;
  }

  async post(...lines) {
    const response = await fetch(`${this.url}slices`, { method: 'POST', body: lines.join('\n') });
    if (!response.ok) throw new Error(`${response.status}: ${await response.text()}`);
  }

  get port() { return new URL(this.url).port; }

  async end(signal = 'SIGKILL') {
    this.process.kill(signal);
    return this.ended;
  }

  #listening() {
    return new Promise((resolve, reject) => {
      let words = '';
      this.process.stderr.setEncoding('utf8').on('data', (more) => {
        words += more;
        const [, url] = /listening on (http:\/\/\S+\/)/.exec(words) ?? [];
        if (url) resolve(url);
      });
      this.ended.then(() => reject(new Error(`loft has ended: ${words}`)));
    });
  }
}

// A square with sides 2 * half around the axis, as a line of a stack.
export function square(z, half, op = 'insert') {
  const contour = [[-half, -half], [half, -half], [half, half], [-half, half]];
  return JSON.stringify({ op, z, contours: [contour], labels: ['box'] });
}
