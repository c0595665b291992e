/** What each of the curve tools asks. */

import type { Reduction } from '../../edit/channels/report.ts';
import {
  bakeExtrapolation,
  bakePreview,
  resample,
  resamplePreview,
  simplify,
  simplifyPreview,
} from '../../edit/commands/channels.ts';
import { scaleKeys } from '../../edit/commands/keys.ts';
import { countKeys } from '../../edit/keys/selection.ts';
import type { DofUnit } from '../../model/skeleton.ts';
import { shownPerUnit, unitText } from '../angles.ts';
import type { DialogContent } from '../dialog.ts';
import { element } from '../dom.ts';
import { count, plural, shown } from '../number-text.ts';
import { dofsFor } from '../timeline/channels.ts';
import { channelsInHand, keysInHand, type Take, takeInHand } from '../timeline/in-hand.ts';
import type { Workbench } from '../workbench.ts';
import { type Answers, type Asked, toolDialog } from './tool-dialog.ts';

/** What is hardly seen: half a degree, a hundredth of a length, half a per cent of a morph. In what is shown. */
const TOLERANCES: Readonly<Record<DofUnit, readonly [string, number, number]>> = {
  angle: ['Angles within', 0.5, 0.01],
  length: ['Lengths within', 0.01, 0.01],
  weight: ['Weights within', 0.005, 0.005],
};
const UNITS: readonly DofUnit[] = ['angle', 'length', 'weight'];

export function simplifyDialog(wb: Workbench, close: () => void): DialogContent {
  return withTake(wb, (take, channels) => {
    const { angles } = wb.settings.get();
    const found = unitsOf(take, channels);
    const document = wb.store.document;
    const toleranceOf = (unit: DofUnit, answers: Answers) =>
      found.includes(unit) ? answers.number(unit) / shownPerUnit(unit, angles) : 1;
    return toolDialog(wb, close, {
      name: 'simplify',
      title: 'Simplify',
      about: `Fewer keys on ${plural(channels.length, 'curve')}, none of which gets further off than this anywhere.`,
      asked: found.map((unit) => {
        const [label, inDegrees, otherwise] = TOLERANCES[unit];
        const value = unit === 'angle' && angles === 'degrees' ? inDegrees : otherwise;
        return { kind: 'number', name: unit, label, value, unit: unitText(unit, angles).trim() };
      }),
      command: simplify,
      args: (answers) => ({
        characterId: take.character.id,
        channels,
        tolerance: {
          angle: toleranceOf('angle', answers),
          length: toleranceOf('length', answers),
          weight: toleranceOf('weight', answers),
        },
      }),
      result: (args) => reductionText(wb, simplifyPreview(document, args)),
    });
  });
}

export function resampleDialog(wb: Workbench, close: () => void): DialogContent {
  return withTake(wb, (take, channels) => {
    const document = wb.store.document;
    return toolDialog(wb, close, {
      name: 'resample',
      title: 'Resample',
      about: `A key on every frame of ${plural(channels.length, 'curve')}; keys outside stay.`,
      asked: [
        number('rate', 'Frames per second', wb.transport.get().framesPerSecond),
        ...rangeAsked(take),
        {
          kind: 'choice',
          name: 'tangents',
          label: 'Tangents',
          value: 'smooth',
          options: [
            ['smooth', 'Smooth'],
            ['linear', 'Linear'],
          ],
        },
      ],
      command: resample,
      args: (answers) => ({
        characterId: take.character.id,
        channels,
        framesPerSecond: answers.number('rate'),
        ...rangeOf(take, answers),
        tangents: answers.choice('tangents') === 'linear' ? ('linear' as const) : ('smooth' as const),
      }),
      result: (args) => reductionText(wb, resamplePreview(document, args)),
    });
  });
}

export function bakeDialog(wb: Workbench, close: () => void): DialogContent {
  return withTake(wb, (take, channels) => {
    const document = wb.store.document;
    return toolDialog(wb, close, {
      name: 'bake',
      title: 'Bake extrapolation to keys',
      about: `What ${plural(channels.length, 'curve')} do beyond their ends, as keys of their own.`,
      asked: rangeAsked(take, wb.transport.get().range),
      command: bakeExtrapolation,
      args: (answers) => ({ characterId: take.character.id, channels, ...rangeOf(take, answers) }),
      result(args) {
        const { keysBefore, keysAfter, periodsChanged } = bakePreview(document, args);
        const keys = `${count(keysBefore)} → ${plural(keysAfter, 'key')}`;
        if (!periodsChanged.length) return keys;
        return `${keys}; ${plural(periodsChanged.length, 'curve')} will repeat in another time on the other side`;
      },
    });
  });
}

export function scaleDialog(wb: Workbench, close: () => void): DialogContent {
  return withTake(wb, (take) => {
    const keys = keysInHand(wb);
    const { angles } = wb.settings.get();
    const found = unitsOf(
      take,
      keys.map((k) => k.channel),
    );
    const dofs = dofsFor(take.character);
    const pivots = found.map((unit): Asked => {
      const what = { angle: 'Angles about', length: 'Lengths about', weight: 'Weights about' }[unit];
      return { kind: 'number', name: unit, label: what, value: 0, unit: unitText(unit, angles).trim() };
    });
    return toolDialog(wb, close, {
      name: 'scaleKeys',
      title: 'Scale keys',
      about: `${plural(countKeys(keys), 'key')}, nearer together or further apart. −1 mirrors.`,
      asked: [
        number('time', 'Time ×', 1),
        number('pivot', 'about', wb.transport.get().timeSeconds, 's'),
        number('value', 'Values ×', 1),
        ...pivots,
      ],
      command: scaleKeys,
      args: (answers) => ({
        characterId: take.character.id,
        keys,
        pivotSeconds: answers.number('pivot') + take.character.timeOffsetSeconds,
        timeFactor: answers.number('time'),
        valueFactor: answers.number('value'),
        pivotValues: keys.map((k) => {
          const unit = dofs[k.channel]?.unit ?? 'weight';
          return answers.number(unit) / shownPerUnit(unit, angles);
        }),
        onCollision: wb.timeline.view.get().onCollision,
      }),
      result: () => '',
    });
  });
}

function withTake(wb: Workbench, make: (take: Take, channels: readonly number[]) => DialogContent): DialogContent {
  const take = takeInHand(wb);
  const channels = channelsInHand(wb).filter((c) => take?.clip.channels[c]?.times.length);
  if (take && channels.length) return make(take, channels);
  const body = element('p', { class: 'empty' }, 'No curve is in view, and no key is selected.');
  return { title: 'Curve tools', body, kind: 'tool-dialog' };
}

function unitsOf(take: Take, channels: readonly number[]): DofUnit[] {
  const dofs = dofsFor(take.character);
  const found = new Set(channels.map((c) => dofs[c]?.unit ?? 'weight'));
  return UNITS.filter((unit) => found.has(unit));
}

function number(name: string, label: string, value: number, unit?: string): Asked {
  return { kind: 'number', name, label, value: Number(value.toPrecision(12)), ...(unit && { unit }) };
}

/** In seconds of the transport. */
function rangeAsked({ clip, character }: Take, range?: readonly [number, number]): Asked[] {
  const offset = character.timeOffsetSeconds;
  return [
    number('from', 'From', range ? range[0] : clip.range[0] - offset, 's'),
    number('to', 'to', range ? range[1] : clip.range[1] - offset, 's'),
  ];
}

/** In seconds of the clip. */
function rangeOf({ character }: Take, answers: Answers) {
  const offset = character.timeOffsetSeconds;
  return { from: answers.number('from') + offset, to: answers.number('to') + offset };
}

/** `1,240 → 86 keys, largest error 0.12°`. */
function reductionText(wb: Workbench, { keysBefore, keysAfter, largest }: Reduction): string {
  const { angles } = wb.settings.get();
  const errors = UNITS.flatMap((unit) => {
    const worst = largest[unit];
    if (!worst) return [];
    return `${shown(worst.largestError * shownPerUnit(unit, angles), 4)}${unitText(unit, angles)}`;
  });
  const error = errors.length ? `, largest error ${errors.join(' / ')}` : '';
  return `${count(keysBefore)} → ${plural(keysAfter, 'key')}${error}`;
}
