// Makes elements. Text from outside becomes text nodes only, never markup.

/** `properties` are set on the element; `on` holds listeners, `aria` and `data` attributes. */
export function el(tag, { on = {}, aria = {}, data = {}, ...properties } = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  for (const [name, listener] of Object.entries(on)) element.addEventListener(name, listener);
  for (const [name, value] of Object.entries(aria)) element.setAttribute(`aria-${name}`, value);
  Object.assign(element.dataset, data);
  element.append(...children.filter((child) => child !== null));
  return element;
}

export const byId = (id) => document.getElementById(id);

export const button = (label, click, properties = {}) =>
  el('button', { type: 'button', textContent: label, on: { click }, ...properties });

const tail = 9;

/** A name that is cut in its middle where it is too long: its end often tells it from others. */
export function middle(name) {
  const cut = name.length > 2 * tail ? name.length - tail : name.length;
  const parts = [name.slice(0, cut), name.slice(cut)].filter(Boolean);
  return el('span', { className: 'middle', title: name },
    ...parts.map((textContent) => el('span', { textContent })));
}

/** Replaces elements; what has the focus keeps it by its place among those that can have it. */
export function keepFocus(parent, replace) {
  const all = () => [...parent.querySelectorAll('button, summary, input')];
  const place = all().indexOf(document.activeElement);
  replace();
  if (place >= 0) all()[place]?.focus({ preventScroll: true });
}

export const section = (title, ...children) =>
  el('section', {}, el('h2', { textContent: title }), ...children);

/** Buttons of which one is pressed; `choices` are [value, label]. */
export function choice(label, choices, chosen) {
  const buttons = new Map(choices.map(([value, words]) =>
    [value, button(words, () => chosen(value), { aria: { pressed: 'false' } })]));
  const element = el('div', { className: 'choice', role: 'group', aria: { label } });
  element.append(...buttons.values());
  const press = (value) => {
    for (const [name, b] of buttons) b.setAttribute('aria-pressed', String(name === value));
  };
  return { element, press };
}
