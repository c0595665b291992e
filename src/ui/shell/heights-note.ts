/**
 * Offers *Same unit* and *Same height* when the visible characters are of very different sizes; until dismissed or
 * another is opened.
 */
import { spreadOfHeights, tensBetween } from '../../edit/same-height.ts';
import type { Character } from '../../model/document.ts';
import { findAction, tryAction } from '../state/actions/action.ts';
import type { Uses } from '../state/workbench.ts';
import { button, element, setText, write } from '../widgets/dom.ts';
import { atMostEvery } from '../widgets/frame.ts';
import { icon } from '../widgets/icons.ts';
import { shown } from '../widgets/numbers/number-text.ts';

/** The largest is more than this many times as tall as the smallest. */
const FAR_APART = 4;

export function heightsNote(wb: Uses<'store' | 'actions' | 'timeline'>): HTMLElement {
  const found = element('span');
  const hint = element('span', { class: 'offer-hint' });
  const text = element('span', { class: 'offer-text', role: 'status' }, found, hint);
  const { comparison } = wb.timeline.takes;
  let dismissed = '';
  let measured: readonly Character[] = [];
  const offerOf = (id: string, label: string) =>
    button(label, { class: 'link' }, label, () => {
      const action = findAction(wb, id);
      // Refused if the selected character has no height of its own.
      if (action) tryAction(wb, action);
    });
  const unit = offerOf('edit.sameUnit', 'Same unit');
  const note = element(
    'section',
    { class: 'offer heights-note', 'aria-label': 'Heights' },
    text,
    unit,
    offerOf('edit.sameHeight', 'Same height'),
    button('Dismiss', { class: 'tool small' }, icon('close'), () => {
      dismissed = idsOf(measured);
      show();
    }),
  );
  const show = () => {
    // Takes that are compared lie over each other: the action would be refused.
    const isComparing = comparison.get() !== undefined;
    const offer = isComparing || idsOf(measured) === dismissed ? undefined : heightsText(measured);
    write(note, 'hidden', offer === undefined);
    setText(found, offer?.[0] ?? '');
    setText(hint, offer?.[1] === undefined ? '' : ` ${offer[1]}`);
    write(unit, 'hidden', unitsApart(measured) === undefined);
  };
  const follow = () => {
    const visible = wb.store.document.characters.filter((c) => !c.isHidden);
    // A pose or a key doesn't change the size: measuring takes longer than that.
    if (visible.length === measured.length && visible.every((c, i) => isAlike(c, measured[i]))) return;
    measured = visible;
    show();
  };
  // Not with the change: of thousands of characters measuring takes a while.
  wb.store.subscribe(atMostEvery(0, follow));
  comparison.subscribe(show);
  follow();
  show();
  return note;
}

/** `The characters are 0.02 to 60 units tall.`, and what the units may be; undefined if they are similar. */
export function heightsText(characters: readonly Character[]): readonly [found: string, hint?: string] | undefined {
  const [least, most] = spreadOfHeights(characters) ?? [1, 1];
  if (!(most > FAR_APART * least)) return undefined;
  const factor = unitsApart(characters);
  const found = `The characters are ${rough(least)} to ${rough(most)} units tall.`;
  const [one, other] = (factor !== undefined && UNITS[factor]) || [];
  return one === undefined ? [found] : [found, `Some may be in ${one}, others in ${other}.`];
}

/** The power of ten between the heights, if that is about all that they differ by. */
export function unitsApart(characters: readonly Character[]): number | undefined {
  const [least, most] = spreadOfHeights(characters) ?? [1, 1];
  const factor = 10 ** tensBetween(least, most);
  const rest = most / least / factor;
  return factor > 1 && rest < ALIKE && rest > 1 / ALIKE ? factor : undefined;
}

/** Characters of one unit differ by no more. */
const ALIKE = 2;
const UNITS: Readonly<Record<number, readonly [string, string]>> = {
  100: ['metres', 'centimetres'],
  1000: ['metres', 'millimetres'],
};

const rough = (height: number) => shown(Number(height.toPrecision(2)));

function isAlike(a: Character, b: Character): boolean {
  return (
    a.id === b.id &&
    a.placements === b.placements &&
    a.space === b.space &&
    a.skeleton === b.skeleton &&
    a.skins === b.skins
  );
}

function idsOf(characters: readonly Character[]): string {
  return characters.map((c) => c.id).join();
}
