/** Dialogs of the tools for whole takes: join, insert, cut out, speed. */
import {
  lockFeet,
  lockFeetSteps,
  loopTakes,
  loopTakesSteps,
  setSpeedSteps,
  setTakeSpeed,
} from '../../../edit/commands/take-edits.ts';
import {
  type CutOut,
  cutOutOfTakes,
  cutOutSteps,
  type InsertInto,
  insertIntoTake,
  insertSteps,
  joinSteps,
  joinTakes,
} from '../../../edit/commands/take-joins.ts';
import type { JoinAlignment } from '../../../edit/samples/join.ts';
import { type Document, findCharacter, shownTake } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element } from '../../widgets/dom.ts';
import { type Answers, type Asked, askChoice, askNumber } from '../../widgets/form/form.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { currentTake, takeTime } from '../timeline/current-take.ts';
import { type ToolDialog, toolDialog } from '../timeline/tool-dialog.ts';
import { takesToEdit, takesToInsert, takesToJoin } from './edited.ts';
import { followRangeOfTakes } from './played-range.ts';

type Page = Uses<'store' | 'transport' | 'timeline' | 'messages' | 'dialog'>;

/** Seconds of the cross-fade. */
const FADE = 0.25;
const HOLD = 1;

const ALIGNMENTS: readonly (readonly [JoinAlignment, string])[] = [
  ['root', 'Root position and heading'],
  ['foot', 'Foot planted in both'],
  ['none', 'None, as recorded'],
];

function fadeAsked(value = FADE): readonly Asked[] {
  return [
    askNumber('fade', 'Cross-fade', value, { unit: 's' }),
    askChoice('align', 'Align', ALIGNMENTS, { value: 'root' }),
  ];
}

function howJoined(answers: Answers) {
  const align = ALIGNMENTS.find(([name]) => name === answers.choice('align'))?.[0];
  return { overlapSeconds: answers.number('fade'), align };
}

/** A dialog whose tool changes how long takes are: the playback range follows. */
function timeDialog<A>(wb: Page, close: () => void, tool: ToolDialog<A>): DialogContent {
  return toolDialog(wb, close, { ...tool, applied: () => followRangeOfTakes(wb) });
}

export function joinDialog(wb: Page, close: () => void): DialogContent {
  const rows = takesToJoin(wb);
  if (rows.length < 2) return empty('Join takes', 'Select two takes or more in the Takes tab first.');
  const names = rows.map(({ name }) => name);
  const list = names.length > 4 ? `${plural(names.length, 'take')}, from ${names[0]} on` : names.join(', then ');
  return timeDialog(wb, close, {
    title: 'Join takes',
    about: `Makes one new take of ${list}. Each continues where the previous one ends.`,
    asked: [...fadeAsked(), askChoice('order', 'Order', { list: 'As in the list', reversed: 'Reversed' })],
    command: joinTakes,
    args: (answers) => ({
      takes: answers.choice('order') === 'reversed' ? rows.toReversed() : rows,
      ...howJoined(answers),
    }),
    *steps(document, args) {
      const change = yield* joinSteps(document, args);
      const before = rows.reduce((sum, { durationSeconds }) => sum + durationSeconds, 0);
      return { change, text: `${shown(before)} s in total become ${lengthText(change, rows[0].characterId)}.` };
    },
  });
}

export function insertDialog(wb: Page, close: () => void): DialogContent {
  const current = currentTake(wb);
  if (!current?.take.samples) return empty('Insert', 'The current take has no samples.');
  const { character, take } = current;
  const others = takesToInsert(wb);
  const at = takeTime(wb, character);
  return timeDialog<InsertInto>(wb, close, {
    title: 'Insert at current time',
    about: `Everything in ${take.name} after ${shown(at)} s moves later and continues from what is inserted.`,
    asked: [
      askChoice('what', 'Insert', [['hold', 'Hold the pose'], ...others.map(({ key, name }) => [key, name] as const)], {
        value: 'hold',
      }),
      askNumber('seconds', 'Hold', HOLD, { unit: 's', shownIf: (answers) => answers.choice('what') === 'hold' }),
      ...fadeAsked(),
    ],
    command: insertIntoTake,
    args(answers) {
      const other = others.find(({ key }) => key === answers.choice('what'));
      const into = { characterId: character.id, take: character.shownTake };
      if (other) return { into, atSeconds: at, take: other, ...howJoined(answers) };
      return { into, atSeconds: at, holdSeconds: answers.number('seconds') };
    },
    *steps(document, args) {
      const change = yield* insertSteps(document, args);
      return { change, text: `${take.name} lasts ${lengthText(change, character.id)}.` };
    },
  });
}

export function cutOutDialog(wb: Page, close: () => void): DialogContent {
  const current = currentTake(wb);
  if (!current?.take.samples) return empty('Cut out', 'The current take has no samples.');
  const { character } = current;
  const [from, to] = wb.transport.get().range;
  const takes = takesToEdit(wb);
  const what = takes.length > 1 ? plural(takes.length, 'take') : current.take.name;
  return timeDialog<CutOut>(wb, close, {
    title: 'Cut out',
    about: `Removes a range of frames from ${what} and closes the gap.`,
    asked: [
      askNumber('from', 'From', Number(from.toFixed(3)), { unit: 's' }),
      askNumber('to', 'to', Number(to.toFixed(3)), { unit: 's' }),
      ...fadeAsked(),
    ],
    command: cutOutOfTakes,
    args: (answers) => ({
      takes,
      from: answers.number('from'),
      to: answers.number('to'),
      areOfTransport: true,
      ...howJoined(answers),
    }),
    *steps(document, args) {
      const change = yield* cutOutSteps(document, args);
      const text = change === document ? 'There are no frames there.' : `${lengthText(change, character.id)} remain.`;
      return { change, text };
    },
  });
}

export function speedDialog(wb: Page, close: () => void): DialogContent {
  const takes = takesToEdit(wb);
  if (!takes.length) return empty('Change speed', 'There is no take to edit.');
  const what = takes.length > 1 ? plural(takes.length, 'take') : 'the take';
  return timeDialog(wb, close, {
    title: 'Change speed',
    about: `Plays ${what} faster or slower along the same path. The frame rate is kept; keys are scaled.`,
    asked: [askNumber('factor', 'Speed ×', 1)],
    command: setTakeSpeed,
    args: (answers) => ({ takes, factor: answers.number('factor') }),
    *steps(document, args) {
      const change = yield* setSpeedSteps(document, args);
      const text = change === document ? 'At 1 nothing changes.' : `Lasts ${lengthText(change, takes[0].characterId)}.`;
      return { change, text };
    },
  });
}

export function loopDialog(wb: Page, close: () => void): DialogContent {
  const takes = takesToEdit(wb);
  if (!takes.length) return empty('Make loop', 'There is no take to edit.');
  const what = takes.length > 1 ? plural(takes.length, 'take') : 'the take';
  return timeDialog(wb, close, {
    title: 'Make loop',
    about: `Blends the end of ${what} into its beginning; a travelling root keeps travelling. Keys get the same value and slope at both ends.`,
    asked: [askNumber('blend', 'Blend', FADE, { unit: 's' })],
    command: loopTakes,
    args: (answers) => ({ takes, blendSeconds: answers.number('blend') }),
    *steps(document, args) {
      const change = yield* loopTakesSteps(document, args);
      const text =
        change === document ? 'It already loops.' : `One cycle lasts ${lengthText(change, takes[0].characterId)}.`;
      return { change, text };
    },
  });
}

export function lockFeetDialog(wb: Page, close: () => void): DialogContent {
  const takes = takesToEdit(wb);
  if (!takes.length) return empty('Lock feet', 'There is no take to edit.');
  const what = takes.length > 1 ? plural(takes.length, 'take') : 'the take';
  return toolDialog(wb, close, {
    title: 'Lock feet',
    // The result is visible in the viewport.
    kind: 'is-aside',
    about: `Finds when the feet of ${what} are on the ground, and holds them still there, moving only the legs.`,
    asked: [
      askNumber('slide', 'Leave slides below', 0.5, { unit: 'mm' }),
      askNumber('ease', 'Ease in and out', 0.1, { unit: 's' }),
    ],
    command: lockFeet,
    args: (answers) => ({
      takes,
      toleranceMetres: answers.number('slide') / 1000,
      easeSeconds: answers.number('ease'),
    }),
    *steps(document, args) {
      const { document: change, contacts, locked, unreached } = yield* lockFeetSteps(document, args);
      const worst = contacts.reduce((most, { slidesBefore }) => Math.max(most, slidesBefore), 0);
      const found = `${plural(contacts.length, 'contact')}; feet slide up to ${shown(1000 * worst, 1)} mm during them.`;
      const text = `${found} ${locked ? `${locked} of them locked.` : 'No foot slides more than that.'}`;
      const frames = plural(unreached, 'frame');
      return { change, text, ...(unreached > 0 && { warning: `In ${frames} a leg can’t reach its target.` }) };
    },
  });
}

/** `3.2 s, 192 frames`: of a character's shown take. */
function lengthText(document: Document, characterId: string): string {
  const character = findCharacter(document, characterId);
  const take = character && shownTake(character);
  if (!take) return '0 s';
  const seconds = `${shown(take.range[1] - take.range[0])} s`;
  return take.samples ? `${seconds}, ${plural(take.samples.frameCount, 'frame')}` : seconds;
}

function empty(title: string, text: string): DialogContent {
  return { title, body: element('p', { class: 'empty' }, text), kind: 'tool-dialog' };
}
