// SPDX-License-Identifier: MIT
// Requests beside those for the surface. Where the page is served to other machines changes need
// the token that came in its address, behind the #: it never leaves the browser but with them.

const token = new URLSearchParams(location.hash.slice(1)).get('token');

// What a page says in JSON; undefined where the server has no such page.
export async function ask(address) {
  const response = await fetch(address);
  if (response.status === 404) return undefined;
  if (!response.ok) throw new Error(`${address}: ${response.status}`);
  return response.json();
}

// Asks for a change; what became of it, in words, where it was refused.
export async function change(address) {
  const headers = token ? { Authorization: `Bearer ${token}` } : {};
  const response = await fetch(address, { method: 'POST', headers });
  if (response.ok) return undefined;
  if (response.status === 401) return 'Changes need the address that loft printed, with its token.';
  const answer = await response.json().catch(() => ({}));
  return answer.error ?? `The server refused it (${response.status}).`;
}
