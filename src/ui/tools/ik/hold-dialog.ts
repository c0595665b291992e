/** Holding pins over a range of time (*foot lock*): what is asked, and what it came to. */
import { type HoldPins, holdPins, holdSteps } from '../../../edit/commands/hold.ts';
import type { HeldTake } from '../../../edit/hold/hold.ts';
import { ikOf } from '../../../evaluate/ik/set-up.ts';
import { shownClip } from '../../../model/document.ts';
import { currentCharacter } from '../../actions/action.ts';
import { toolDialog } from '../../curves/tool-dialog.ts';
import type { DialogContent } from '../../dialog.ts';
import { element } from '../../dom.ts';
import { plural, shown } from '../../number-text.ts';
import type { Workbench } from '../../workbench.ts';
import { jointName } from './gap-text.ts';
import { selectedPin } from './in-hand.ts';

const TITLE = 'Hold pins';
/** How long the way to the held place takes, and that back: seconds. */
const EASE_SECONDS = 0.1;

export function holdDialog(wb: Workbench, close: () => void): DialogContent {
  const character = currentCharacter(wb);
  const pins = character ? ikOf(character).pins : [];
  if (!character || pins.length === 0) return nothing('No point of the character is pinned: pin one in IK mode first.');
  if (!shownClip(character)) return nothing(`${character.name} shows no take: nothing moves that could be held.`);
  const { range, timeSeconds, framesPerSecond } = wb.transport.get();
  const all = pins.length === 1 ? 'The pin' : `All ${pins.length} pins`;
  const selected = selectedPin(wb);
  const chosen = selected?.character.id === character.id ? String(selected.pin.id) : 'all';
  return toolDialog<HoldPins>(wb, close, {
    name: 'holdPins',
    title: TITLE,
    about:
      'What is pinned stays where it is at one moment for all of a range, as a foot that is not to slide; the take gets ' +
      'keys for it, or other frames where it has frames.',
    asked: [
      {
        kind: 'choice',
        name: 'pins',
        label: 'Pins',
        value: chosen,
        options: [['all', all], ...pins.map(({ id, joint }) => [String(id), jointName(character, joint)] as const)],
      },
      { kind: 'number', name: 'from', label: 'From', value: tidy(range[0]), unit: 's' },
      { kind: 'number', name: 'to', label: 'To', value: tidy(range[1]), unit: 's' },
      { kind: 'number', name: 'at', label: 'Where it is at', value: tidy(timeSeconds), unit: 's' },
      { kind: 'number', name: 'ease', label: 'Way there and back', value: EASE_SECONDS, unit: 's' },
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
    *steps(document, args) {
      const { edit, report } = yield* holdSteps(document, args);
      return { change: edit, text: heldText(report) };
    },
    result: () => '',
  });
}

/** `12 curves changed; slides at most 0.0001 where it slid 0.21.` */
function heldText({ channels, pins, unreached }: HeldTake): string {
  if (channels.length === 0) return 'Nothing has to change: it stays there anyway.';
  const most = (of: (pin: HeldTake['pins'][number]) => number) => shown(Math.max(...pins.map(of)), 4);
  const slides = `slides at most ${most((pin) => pin.slideAfter)} where it slid ${most((pin) => pin.slideBefore)}`;
  const missed = unreached > 0 ? ` Out of reach in ${plural(unreached, 'frame')}.` : '';
  return `${plural(channels.length, 'curve')} changed; ${slides}.${missed}`;
}

/** To the tenth of a millisecond: a playhead stands anywhere between two frames. */
function tidy(seconds: number): number {
  return Number(seconds.toFixed(4));
}

function nothing(why: string): DialogContent {
  return { title: TITLE, body: element('p', { class: 'faint' }, why), kind: 'tool-dialog' };
}
