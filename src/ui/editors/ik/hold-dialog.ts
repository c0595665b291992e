/** The dialog for holding pins over a time range (*foot lock*), and its result. */
import { type HoldPins, holdPins, holdSteps } from '../../../edit/commands/hold.ts';
import type { HeldTake } from '../../../edit/hold/hold.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { keysOf, repeats } from '../../../model/takes/take.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element } from '../../widgets/dom.ts';
import { askChoice, askNumber } from '../../widgets/form/form.ts';
import { errorSize, plural } from '../../widgets/numbers/number-text.ts';
import { toolDialog } from '../timeline/tool-dialog.ts';
import { selectedPin } from './selected-pin.ts';

const TITLE = 'Hold pins';
/** Seconds to ease in and out. */
const EASE_SECONDS = 0.1;
/** Longer ranges are computed on request only. */
const QUICK_SECONDS = 2;
/** About the length of a foot contact. */
const STEP_SECONDS = 0.5;
/** Maximum number of curves listed; the rest is counted. */
const MAX_NAMED = 3;

export function holdDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  const character = currentCharacter(wb);
  const pins = character ? ikOf(character).pins : [];
  if (!character || pins.length === 0) return nothing('No point of the character is pinned. Pin one in IK mode first.');
  if (!shownTake(character))
    return nothing(`${character.name} has no current take, so there is no motion to hold pins in.`);
  const { range: played, timeSeconds, framesPerSecond } = wb.transport.get();
  const range = firstRange(played, timeSeconds);
  const all = pins.length === 1 ? 'The pin' : `All ${pins.length} pins`;
  const selected = selectedPin(wb);
  const chosen = selected?.character.id === character.id ? String(selected.pin.id) : 'all';
  return toolDialog<HoldPins>(wb, close, {
    title: TITLE,
    // The result is visible in the viewport.
    kind: 'is-aside',
    about:
      'Holds pinned points still over a range, for example to stop a foot from sliding. The take gets ' +
      'new keys, or new samples if it is sampled.',
    asked: [
      askChoice(
        'pins',
        'Pins',
        [['all', all], ...pins.map(({ id, joint }) => [String(id), jointName(character.skeleton, joint)] as const)],
        { value: chosen },
      ),
      askNumber('from', 'From', tidy(range[0]), { unit: 's' }),
      askNumber('to', 'To', tidy(range[1]), { unit: 's' }),
      askNumber('at', 'Hold position at', tidy(timeSeconds), { unit: 's' }),
      askNumber('ease', 'Ease in and out', EASE_SECONDS, { unit: 's' }),
    ],
    command: holdPins,
    args: (answers) => {
      const which = answers.choice('pins');
      return {
        characterId: character.id,
        pins: which === 'all' ? pins.map(({ id }) => id) : [Number(which)],
        range: [answers.number('from'), answers.number('to')],
        atSeconds: answers.number('at'),
        framesPerSecond,
        easeSeconds: answers.number('ease'),
      };
    },
    takesLong: ({ range: [from, to] }) => Math.min(to, played[1]) - Math.max(from, played[0]) > QUICK_SECONDS,
    *steps(document, args) {
      const { edit, report } = yield* holdSteps(document, args);
      const warning = writtenOutText(character, report);
      return { change: edit, text: heldText(report), ...(warning && { warning }) };
    },
  });
}

/** Short enough to be computed at once: the whole playback range, or a step from the current time. */
export function firstRange([start, end]: readonly [number, number], now: number): readonly [number, number] {
  if (end - start <= QUICK_SECONDS) return [start, end];
  const from = Math.min(Math.max(now, start), end - STEP_SECONDS);
  return [from, from + STEP_SECONDS];
}

/** Curves that repeated: their single period is written out as keys over the playback range only. */
export function writtenOutText(before: Character, { take, channels }: Pick<HeldTake, 'take' | 'channels'>): string {
  const own = shownTake(before);
  const dofs = characterDofs(before.skeleton, before.morphs);
  const names = channels
    .filter((channel) => {
      const [was, now] = [own?.channels[channel], take.channels[channel]];
      if (!was || keysOf(was).times.length < 2) return false;
      const isLost = (side: 'extrapolateIn' | 'extrapolateOut') => repeats(was[side]) && !repeats(now[side]);
      return isLost('extrapolateIn') || isLost('extrapolateOut');
    })
    .map((channel) => `${jointName(before.skeleton, dofs[channel].joint)} ${dofs[channel].name}`);
  if (names.length === 0) return '';
  const named = names.slice(0, MAX_NAMED);
  const more = names.length - named.length;
  const list = `${named.join(', ')}${more > 0 ? ` and ${more} more` : ''}`;
  return `${list} no longer ${names.length === 1 ? 'repeats' : 'repeat'}: keys replace the cycle over the playback range.`;
}

/** `12 curves changed; slides at most 0.0001 where it slid 0.21.` */
function heldText({ channels, pins, unreached }: HeldTake): string {
  if (channels.length === 0) return 'Nothing to change: the points already stay in place.';
  const most = (of: (pin: HeldTake['pins'][number]) => number) => errorSize(Math.max(...pins.map(of)));
  const slides = `largest slide ${most((pin) => pin.slideAfter)}, was ${most((pin) => pin.slideBefore)}`;
  const missed = unreached > 0 ? ` Out of reach in ${plural(unreached, 'frame')}.` : '';
  return `${plural(channels.length, 'curve')} changed; ${slides}.${missed}`;
}

/** To a tenth of a millisecond: the playhead may be between frames. */
function tidy(seconds: number): number {
  return Number(seconds.toFixed(4));
}

function nothing(why: string): DialogContent {
  return { title: TITLE, body: element('p', { class: 'faint' }, why), kind: 'tool-dialog' };
}
