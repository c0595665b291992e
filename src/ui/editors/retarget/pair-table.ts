/**
 * The joint map as a table: a row for each joint of the target, with the source joint that it follows and why. Options
 * are filled in when a list is opened: a hundred joints with a hundred options each would be ten thousand elements.
 */
import type { MatchedPair } from '../../../evaluate/retarget/match.ts';
import { jointName, shortJointName } from '../../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { JointPair } from '../../../model/takes/retarget.ts';
import { element, setAttribute, setText, uniqueId } from '../../widgets/dom.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

const AT_REST = 'keeps its pose';
/** Matches below this confidence are guesses. */
const UNSURE = 0.6;

export interface PairTable {
  readonly element: HTMLElement;
  /** As edited, in the order of the target's joints. */
  pairs(): JointPair[];
  /** Tells whatever it is in, as its lists do when the user chooses another joint. */
  tellChanged(): void;
  show(target: Skeleton, source: Skeleton, pairs: readonly JointPair[], matches: readonly MatchedPair[]): void;
}

/** The user's choices are `input` events of it. */
export function pairTable(): PairTable {
  const body = element('tbody');
  const table = element(
    'table',
    { class: 'pairs' },
    element('thead', {}, element('tr', {}, head('Joint'), head('follows'), head('because'))),
    body,
  );
  let chosen = new Map<number, number>();
  return {
    element: element('div', { class: 'pairs-scroll', tabindex: '0', role: 'group', 'aria-label': 'Joints' }, table),
    tellChanged: () => void table.dispatchEvent(new Event('input', { bubbles: true })),
    pairs: () => [...chosen].sort(([a], [b]) => a - b).map(([target, source]) => ({ target, source })),
    show(target, source, pairs, matches) {
      chosen = new Map(pairs.map((pair) => [pair.target, pair.source]));
      const found = new Map(matches.map((match) => [match.target, match]));
      const depths = depthsOf(target);
      body.replaceChildren(
        ...target.joints.map((_, t) => {
          const name = jointName(target, t);
          const why = element('td', { class: 'why', id: uniqueId('why') });
          const select = jointSelect(`${name} follows`, source, chosen.get(t));
          // For screen readers, along with the choice; others see colour and tooltip.
          setAttribute(select, 'aria-describedby', why.id);
          const label = element('span', {}, shortJointName(target, t));
          label.style.paddingLeft = `${Math.min(depths[t], 12) * 6}px`;
          const row = element(
            'tr',
            {},
            element('th', { scope: 'row', tooltip: name }, label),
            element('td', {}, select),
            why,
          );
          const explain = () => {
            const s = chosen.get(t);
            const match = found.get(t);
            const isFound = match !== undefined && match.source === s;
            row.classList.toggle('unmatched', s === undefined);
            row.classList.toggle('unsure', isFound && match.confidence < UNSURE);
            const reason = isFound ? match.reason : 'set by hand';
            const isGuess = isFound && match.confidence < UNSURE;
            setText(why, s === undefined ? AT_REST : isGuess ? `guess: ${reason}` : reason);
            setTooltip(why, isFound ? `${reason}. ${sureness(match.confidence)}` : '');
          };
          select.addEventListener('input', () => {
            if (select.value === '') chosen.delete(t);
            else chosen.set(t, Number(select.value));
            explain();
          });
          explain();
          return row;
        }),
      );
    },
  };
}

/** Confidence of a match, in words and as a number. */
function sureness(confidence: number): string {
  const percent = `${Math.round(100 * confidence)} %`;
  if (confidence >= 0.85) return `Sure (${percent}).`;
  if (confidence >= UNSURE) return `Likely (${percent}).`;
  return `A guess (${percent}). Check that it moves correctly.`;
}

function head(text: string): HTMLElement {
  return element('th', { scope: 'col' }, text);
}

function jointSelect(label: string, source: Skeleton, chosen: number | undefined): HTMLSelectElement {
  const optionOf = (s: number) => element('option', { value: s, selected: s === chosen }, shortJointName(source, s));
  const none = () => element('option', { value: '', selected: chosen === undefined }, '—');
  const select = element('select', { 'aria-label': label }, chosen === undefined ? none() : optionOf(chosen));
  const fill = () => {
    const { value } = select;
    select.replaceChildren(none(), ...source.joints.map((_, s) => optionOf(s)));
    select.value = value;
  };
  for (const event of ['focus', 'pointerdown'] as const) select.addEventListener(event, fill, { once: true });
  return select;
}

function depthsOf({ joints }: Skeleton): number[] {
  const depths: number[] = [];
  for (const { parent } of joints) depths.push(parent < 0 ? 0 : depths[parent] + 1);
  return depths;
}
