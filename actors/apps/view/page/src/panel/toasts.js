// Short messages about failures and successes; they disappear by themselves.
import { button, byId, el } from './dom.js';

const stays_ms = 8000;
const shownMost = 4;

export function toast(words, kind = 'error') {
  const list = byId('toasts');
  const last = list.lastElementChild;
  if (last?.dataset.words === words) last.remove();
  const item = el('div', { className: `toast ${kind}`, data: { words } },
    el('p', { textContent: words }));
  item.append(button('×', () => item.remove(), { aria: { label: 'Dismiss' } }));
  list.append(item);
  while (list.children.length > shownMost) list.firstElementChild.remove();
  setTimeout(() => item.remove(), stays_ms);
}
