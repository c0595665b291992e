/** Dialogs of the curve tools. */
import type { Reduction } from '../../../../edit/channels/report.ts';
import {
  bakeExtrapolation,
  bakePreview,
  resample,
  resamplePreview,
  simplify,
  simplifyPreview,
} from '../../../../edit/commands/channels.ts';
import { scaleKeys } from '../../../../edit/commands/keys.ts';
import { countKeys } from '../../../../edit/keys/selection.ts';
import { type Document, findCharacter, shownTake } from '../../../../model/document.ts';
import type { DofUnit } from '../../../../model/skeleton/skeleton.ts';
import { keysOf } from '../../../../model/takes/take.ts';
import { shownPerUnit, unitText } from '../../../state/joints/angles.ts';
import type { Uses } from '../../../state/workbench.ts';
import type { DialogContent } from '../../../widgets/dialog.ts';
import { element } from '../../../widgets/dom.ts';
import { type Asked, askChoice, askNumber } from '../../../widgets/form/form.ts';
import { count, errorSize, plural } from '../../../widgets/numbers/number-text.ts';
import { type CurrentTake, currentTake, ownChannelsToEdit, ownKeysInView } from '../../timeline/current-take.ts';
import { toolDialog } from '../../timeline/tool-dialog.ts';
import {
  bakeArguments,
  resampleArguments,
  scaleArguments,
  simplifyArguments,
  UNITS,
  unitsOf,
} from './tool-arguments.ts';
import { changesBeyond } from './tool-changes.ts';

/**
 * Hardly visible differences: half a degree, a hundredth of a length, half a per cent of a scale or morph. In displayed
 * units.
 */
const TOLERANCES: Readonly<Record<DofUnit, readonly [string, number, number]>> = {
  angle: ['Angle tolerance', 0.5, 0.01],
  length: ['Length tolerance', 0.01, 0.01],
  factor: ['Factor tolerance', 0.005, 0.005],
  weight: ['Weight tolerance', 0.005, 0.005],
};

export function simplifyDialog(
  wb: Uses<'store' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  return withTake(wb, (current, channels) => {
    const { angles } = wb.settings.get();
    const found = unitsOf(current.character, channels);
    const document = wb.store.document;
    return toolDialog(wb, close, {
      title: 'Simplify',
      about: `Removes keys from ${plural(channels.length, 'curve')} while each curve stays within this tolerance.`,
      asked: found.map((unit) => {
        const [label, inDegrees, otherwise] = TOLERANCES[unit];
        const value = unit === 'angle' && angles === 'degrees' ? inDegrees : otherwise;
        return askNumber(unit, label, value, { unit: unitText(unit, angles).trim() });
      }),
      command: simplify,
      args: (answers) => simplifyArguments(current.character, channels, answers, angles),
      result: (args) => reductionText(wb, simplifyPreview(document, args)),
    });
  });
}

export function resampleDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  return withTake(wb, (current, channels) => {
    const document = wb.store.document;
    return toolDialog(wb, close, {
      title: 'Resample',
      about: `Sets a key on every frame of ${plural(channels.length, 'curve')}. Keys outside the range are kept.`,
      asked: [
        number('rate', 'Frames per second', wb.transport.get().framesPerSecond),
        ...rangeAsked(keysSpan(current, channels)),
        askChoice('tangents', 'Tangents', { smooth: 'Smooth', linear: 'Linear' }),
      ],
      command: resample,
      args: (answers) => resampleArguments(current.character, channels, answers),
      result: (args, after) =>
        [`${reductionText(wb, resamplePreview(document, args))}.`, ...beyond(current, after, channels)].join('\n'),
    });
  });
}

export function bakeDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  return withTake(wb, (current, channels) => {
    const document = wb.store.document;
    return toolDialog(wb, close, {
      title: 'Bake extrapolation to keys',
      about: `Turns the extrapolation of ${plural(channels.length, 'curve')} into keys.`,
      asked: rangeAsked(wb.transport.get().range),
      command: bakeExtrapolation,
      args: (answers) => bakeArguments(current.character, channels, answers),
      result(args, after) {
        const { keysBefore, keysAfter } = bakePreview(document, args);
        const keys = `${count(keysBefore)} → ${plural(keysAfter, 'key')}.`;
        return [keys, ...beyond(current, after, channels)].join('\n');
      },
    });
  });
}

export function scaleDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  return withTake(wb, (current) => {
    const keys = ownKeysInView(wb);
    const { angles } = wb.settings.get();
    const found = unitsOf(
      current.character,
      keys.map((k) => k.channel),
    );
    const pivots = found.map((unit): Asked => {
      const what = `${{ angle: 'Angle', length: 'Length', factor: 'Factor', weight: 'Weight' }[unit]} pivot`;
      return askNumber(unit, what, 0, { unit: unitText(unit, angles).trim() });
    });
    return toolDialog(wb, close, {
      title: 'Scale keys',
      about: `Scales ${plural(countKeys(current.take.channels, keys), 'key')} about a pivot. −1 mirrors.`,
      asked: [
        number('time', 'Time ×', 1),
        number('pivot', 'about', wb.transport.get().timeSeconds, 's'),
        number('value', 'Values ×', 1),
        ...pivots,
      ],
      command: scaleKeys,
      args: (answers) => ({
        ...scaleArguments(current.character, keys, answers, angles),
        onCollision: wb.timeline.view.get().onCollision,
      }),
    });
  });
}

function withTake(
  wb: Uses<'store' | 'timeline'>,
  make: (current: CurrentTake, channels: readonly number[]) => DialogContent,
): DialogContent {
  const current = currentTake(wb);
  const channels = ownChannelsToEdit(wb).filter((c) => current?.take.channels[c]?.kind === 'keys');
  if (current && channels.length) return make(current, channels);
  const body = element('p', { class: 'empty' }, 'No curve is visible and no key is selected.');
  return { title: 'Curve tools', body, kind: 'tool-dialog' };
}

function number(name: string, label: string, value: number, unit?: string): Asked {
  return askNumber(name, label, Number(value.toPrecision(12)), { ...(unit && { unit }) });
}

/** In seconds of the transport. */
function rangeAsked(range: readonly [number, number]): Asked[] {
  return [number('from', 'From', range[0], 's'), number('to', 'to', range[1], 's')];
}

/** From the first key of these channels to the last one, in seconds of the transport. */
function keysSpan({ take, character }: CurrentTake, channels: readonly number[]): readonly [number, number] {
  let [from, to] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const { times } of channels.map((c) => keysOf(take.channels[c]))) {
    from = Math.min(from, times[0]);
    to = Math.max(to, times[times.length - 1]);
  }
  const offset = character.timeOffsetSeconds;
  return [from - offset, to - offset];
}

/** Changes of the take's extrapolation. */
function beyond({ character, take }: CurrentTake, after: Document, channels: readonly number[]): string[] {
  const changed = findCharacter(after, character.id);
  const now = changed && shownTake(changed);
  return now ? changesBeyond(take, now, channels) : [];
}

/** `1,240 → 86 keys, largest error 0.12°`. */
function reductionText(wb: Uses<'settings'>, { keysBefore, keysAfter, largest }: Reduction): string {
  const { angles } = wb.settings.get();
  const errors = UNITS.flatMap((unit) => {
    const worst = largest[unit];
    if (!worst) return [];
    return `${errorSize(worst.largestError * shownPerUnit(unit, angles))}${unitText(unit, angles)}`;
  });
  const error = errors.length ? `, largest error ${errors.join(' / ')}` : '';
  return `${count(keysBefore)} → ${plural(keysAfter, 'key')}${error}`;
}
