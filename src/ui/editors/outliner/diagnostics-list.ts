/**
 * Every message that has not been dismissed, with its diagnostics: place, problem, assumption, and the line itself with
 * a caret.
 */
import type { Diagnostic } from '../../../model/diagnostic.ts';
import { problemLink } from '../../state/manual-link.ts';
import { caretPad, counts, groupByFile, type Message } from '../../state/messages.ts';
import { offerButton } from '../../state/offer-button.ts';
import { showInSource } from '../../state/panels/show-in-source.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { count, plural } from '../../widgets/numbers/number-text.ts';

/** The rest is counted; Copy includes all. */
const MAX_SHOWN = 200;
const EXCERPT_CHARACTERS = 200;

export function diagnosticsList(wb: Uses<'messages' | 'timeline' | 'settings'>): HTMLElement {
  const list = element('div', { class: 'messages-list scrolls', tabindex: 0 });
  const carets = caretsInView();
  const show = (messages: readonly Message[]) => {
    if (!messages.length) {
      list.replaceChildren(element('p', { class: 'empty' }, 'Problems in your files appear here, with line numbers.'));
      return;
    }
    let room = MAX_SHOWN;
    const shown = [...messages].reverse().map((message) => {
      const block = messageBlock(wb, message, Math.max(0, room));
      room -= message.diagnostics.length;
      return block;
    });
    list.replaceChildren(...shown);
    carets.watch(list.querySelectorAll<HTMLElement>('.excerpt'));
  };
  wb.messages.list.subscribe(show);
  show(wb.messages.list.get());
  return list;
}

function messageBlock(wb: Uses<'messages' | 'timeline' | 'settings'>, message: Message, room: number): HTMLElement {
  const { diagnostics, severity, text, fate } = message;
  const first = diagnostics[0]?.file;
  const isOfMany = diagnostics.some(({ file }) => file !== first);
  const file = isOfMany ? '' : first;
  const shown = diagnostics.slice(0, room);
  // A single one needs no count: the icon shows its severity.
  const counted = diagnostics.length > 1 && counts(diagnostics);
  const mixed = diagnostics.some((d) => d.severity !== severity);
  return element(
    'article',
    { class: 'message' },
    element(
      'div',
      { class: `message-head severity-${severity}` },
      icon(severity),
      element(
        'span',
        { class: `message-title ${file ? 'is-file' : ''}`, tooltip: text },
        isOfMany ? filesText(diagnostics) : diagnostics.length ? file || 'Opening' : text,
      ),
      button('Dismiss', { class: 'tool small' }, icon('close'), () => wb.messages.dismiss(message.id)),
    ),
    counted && element('p', { class: 'message-count' }, counted),
    message.offers?.length
      ? element('div', { class: 'message-offers' }, ...message.offers.map(offerButton))
      : undefined,
    fate && element('p', { class: 'message-fate' }, `${fate[0].toUpperCase()}${fate.slice(1)}`),
    ...(isOfMany ? [filesBlock(wb, shown, mixed)] : shown.map((d) => diagnosticBlock(wb, d, mixed))),
    diagnostics.length > shown.length &&
      element(
        'p',
        { class: 'faint' },
        `… and ${count(diagnostics.length - shown.length)} more. Copy includes all of them.`,
      ),
  );
}

/** Which they are is below; the line over the viewport also tells the first. */
const filesText = (diagnostics: readonly Diagnostic[]) => plural(groupByFile(diagnostics).size, 'file');

/** Problems of many files, unfolded on demand. */
function filesBlock(wb: Uses<'timeline' | 'settings'>, shown: readonly Diagnostic[], mixed: boolean): HTMLElement {
  const blocks = [...groupByFile(shown)].flatMap(([file, found]) => [
    element('p', { class: 'message-title is-file', tooltip: file }, file || 'Opening'),
    ...found.map((d) => diagnosticBlock(wb, d, mixed)),
  ]);
  return element('details', {}, element('summary', {}, 'Files'), ...blocks);
}

function diagnosticBlock(wb: Uses<'timeline' | 'settings'>, d: Diagnostic, withIcon: boolean): HTMLElement {
  const place = d.line > 0 ? `${d.line}:${d.column}` : '';
  return element(
    'div',
    { class: 'diagnostic', tooltip: d.code },
    element(
      'p',
      { class: `severity-${d.severity}` },
      withIcon && icon(d.severity),
      place &&
        button(`Show ${place} of ${d.file} in Source`, { class: 'place link' }, place, () => showInSource(wb, d)),
      element('span', { class: 'sentence' }, d.message, d.assumed && element('i', {}, ` (${d.assumed})`)),
    ),
    d.excerpt && excerpt(d.excerpt.text, d.excerpt.caret),
    problemLink(d.code),
  );
}

/**
 * Scrolls long lines so that the caret is visible, about the middle. On first showing, since there is no width before.
 */
function caretsInView(): { watch(excerpts: Iterable<HTMLElement>): void } {
  const observer = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      if (!isIntersecting) continue;
      observer.unobserve(target);
      const caret = target.querySelector<HTMLElement>('.caret');
      if (caret) target.scrollLeft = caret.offsetLeft + caret.offsetWidth - target.clientWidth / 2;
    }
  });
  return {
    watch(excerpts) {
      observer.disconnect();
      for (const excerpt of excerpts) observer.observe(excerpt);
    },
  };
}

/** The line and its caret, as text: content of files is never markup. */
function excerpt(text: string, caret: number): HTMLElement {
  const line = text.slice(0, EXCERPT_CHARACTERS);
  const block = element('pre', { class: 'excerpt', tabindex: 0 });
  block.append(`${line}\n${caretPad(line, Math.min(caret, line.length))}`, element('span', { class: 'caret' }, '^'));
  return block;
}
