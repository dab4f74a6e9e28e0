// SPDX-License-Identifier: MIT
// Copying, also where a page from another machine without https may not use the clipboard directly.

// `parent` is what the selection may be in, an open dialog for instance.
function copySelected(text, parent) {
  const field = parent.appendChild(document.createElement('textarea'));
  const { activeElement: before } = document;
  field.className = 'unseen';
  field.value = text;
  field.select();
  const isCopied = document.execCommand('copy');
  field.remove();
  before?.focus();
  return isCopied;
}

// Whether it could be done.
export async function copy(text, parent = document.body) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copySelected(text, parent);
  }
}
