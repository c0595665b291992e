/** Creates elements, in one expression and never from markup: text from files stays text. */
import { cutMessage } from '../../model/names/cut-text.ts';
import { isTextField, leaveField } from './focus/focus.ts';
import { setTooltip } from './tooltip.ts';

type Attributes = Readonly<Record<string, string | number | boolean | undefined>>;
type Child = Node | string | undefined | false;

/** `true` sets an empty attribute, `false` and undefined none; `tooltip` is its tooltip, as by `setTooltip`. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (name === 'tooltip') setTooltip(made, String(value));
    else made.setAttribute(name, value === true ? '' : bounded(name, String(value)));
  }
  for (const child of children) if (child) made.append(typeof child === 'string' ? cutMessage(child, LONGEST) : child);
  return made;
}

/** A button; `label` is its accessible name and tooltip. */
export function button(label: string, attributes: Attributes, content: Child, onClick: () => void): HTMLButtonElement {
  const made = element('button', { type: 'button', 'aria-label': label, tooltip: label, ...attributes }, content);
  made.addEventListener('click', onClick);
  return made;
}

/**
 * A mouse click on it keeps the focus elsewhere, so that shortcuts keep their meaning. Tab still reaches it. Only a
 * text field loses the focus, as with any other click: editing ends, and keys belong to the panel again.
 */
export function keepsFocusElsewhere<T extends HTMLElement>(target: T): T {
  target.addEventListener('mousedown', (event) => {
    event.preventDefault();
    const { activeElement } = document;
    if (isTextField(activeElement) && !target.contains(activeElement)) leaveField(activeElement, target);
  });
  return target;
}

export function setText(target: Element, text: string): void {
  const shown = cutMessage(text, LONGEST);
  if (target.textContent !== shown) target.textContent = shown;
}

/** Characters of a text: names of files and in files have any length, and a page that holds them all has none left. */
const LONGEST = 20_000;

/** Of the attributes, only names that are read aloud come from files. */
function bounded(name: string, value: string): string {
  return name === 'aria-label' ? cutMessage(value) : value;
}

/**
 * Writes a property, such as `hidden`, if it differs: browsers take an equal one for a change too, and compute styles
 * and layout for it. So all that follows time, drags or the document writes by this, or by the functions around it.
 */
export function write<T extends object, K extends keyof T>(target: T, property: K, value: T[K]): void {
  if (target[property] !== value) target[property] = value;
}

/** The same for an attribute; undefined removes it. */
export function setAttribute(target: Element, name: string, value: string | undefined): void {
  if (value === undefined) target.removeAttribute(name);
  else if (target.getAttribute(name) !== bounded(name, value)) target.setAttribute(name, bounded(name, value));
}

/** The same for a property of its style; empty removes it. */
export function setStyle(target: ElementCSSInlineStyle, property: string, value: string): void {
  if (target.style.getPropertyValue(property) !== value) target.style.setProperty(property, value);
}

/** A unique id for aria attributes to refer to. */
export function uniqueId(prefix: string): string {
  return `${prefix}-${++ids}`;
}
let ids = 0;
