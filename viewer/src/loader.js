// SPDX-License-Identifier: MIT
// Fetches with few requests at a time, the newest wish first. The browser has six connections to a
// server, and the events keep one of them.

export class Loader {
  #waiting = [];
  #running = 0;
  #limit;

  constructor(limit = 4) {
    this.#limit = limit;
  }

  // `isWanted` is asked just before the request; `take` gets the response, `miss` is called where
  // there is none (404). A request that fails otherwise is tried again a little later.
  fetch(address, isWanted, take, miss = () => {}) {
    this.#waiting.push({ address, isWanted, take, miss, tries: 0 });
    if (this.#waiting.length % 1024 === 0)
      this.#waiting = this.#waiting.filter((wish) => wish.isWanted());
    this.#next();
  }

  #next() {
    while (this.#running < this.#limit && this.#waiting.length > 0) {
      const wish = this.#waiting.pop();
      if (wish.isWanted()) this.#run(wish);
    }
  }

  async #run(wish) {
    ++this.#running;
    try {
      const response = await fetch(wish.address);
      if (response.ok) await wish.take(response);
      else if (response.status === 404) wish.miss();
      else throw new Error(`${wish.address}: ${response.status}`);
    } catch {
      this.#later(wish);
    }
    --this.#running;
    this.#next();
  }

  #later(wish) {
    ++wish.tries;
    setTimeout(() => {
      this.#waiting.push(wish);
      this.#next();
    }, Math.min(250 * 2 ** wish.tries, 8000));
  }
}
