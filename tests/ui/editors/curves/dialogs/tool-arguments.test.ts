import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../../../src/edit/command-error.ts';
import { resample, simplify } from '../../../../../src/edit/commands/channels.ts';
import { scaleKeys } from '../../../../../src/edit/commands/keys.ts';
import { shownTake } from '../../../../../src/model/document.ts';
import { keysOf } from '../../../../../src/model/takes/take.ts';
import {
  bakeArguments,
  resampleArguments,
  scaleArguments,
  simplifyArguments,
  unitsOf,
} from '../../../../../src/ui/editors/curves/dialogs/tool-arguments.ts';
import type { Answers } from '../../../../../src/ui/widgets/form/form.ts';
import { channel, character, documentOf, skeleton, take } from '../../../builders.ts';

/** Fails, like the dialog, if something is read that was not asked for. */
function typed(given: Readonly<Record<string, number | string>>): Answers {
  return {
    number(name) {
      const value = given[name];
      if (typeof value !== 'number') throw new Error(`${name} was not asked for.`);
      return value;
    },
    choice: (name) => String(given[name]),
  };
}

/** A key per frame, and a wave of this height. */
function wave(height: number) {
  const times = Array.from({ length: 61 }, (_, i) => i / 30);
  return { ...channel(...times), values: Float64Array.from(times, (t) => height * Math.sin(6 * t)) };
}

const waves = (count: number) => take([0, 2], ...Array.from({ length: count }, () => wave(1)));
/** Root translation, three angles, and two channels beyond the DOFs. */
const walker = character({ skeleton: skeleton(['hips', -1]), takes: [waves(8)], timeOffsetSeconds: 0.25 });
/** Like an `.anim` that was opened alone. */
const alone = character({ takes: [waves(6)] });

describe('what simplifying is asked for', () => {
  it('the simplify dialog asks for tolerances in the units that occur; a channel without a DOF has plain numbers', () => {
    expect(unitsOf(walker, [3, 4])).toEqual(['angle']);
    expect(unitsOf(walker, [7, 0, 3])).toEqual(['angle', 'length', 'weight']);
    expect(unitsOf(alone, [0, 5])).toEqual(['length', 'weight']);
  });

  it('the simplify dialog passes on exactly those units, angles in radians', () => {
    const { tolerance } = simplifyArguments(walker, [3, 7], typed({ angle: 90, weight: 0.5 }), 'degrees');
    expect(tolerance).toEqual({ angle: Math.PI / 2, weight: 0.5 });
    expect(simplifyArguments(walker, [3], typed({ angle: 2 }), 'radians').tolerance).toEqual({ angle: 2 });
  });

  it('channels without a DOF count, too', () => {
    for (const [of, channels] of [
      [alone, [4, 5]],
      [walker, [6, 7]],
    ] as const) {
      const keysWithin = (weight: number) => {
        const args = simplifyArguments(of, channels, typed({ weight }), 'degrees');
        const [after] = simplify.run(documentOf(of), args).document.characters;
        return keysOf(shownTake(after)?.channels[channels[0]]).times.length;
      };
      expect(keysWithin(1e-9)).toBe(61);
      expect(keysWithin(0.5)).toBeLessThan(20);
    }
  });

  it('the command refuses a missing unit, and accepts an unneeded one', () => {
    const document = documentOf(walker);
    const run = (channels: number[]) =>
      simplify.run(document, { characterId: 'c1', channels, tolerance: { angle: 1 } });
    expect(() => run([3, 7])).toThrow(CommandError);
    expect(() => run([3, 7])).toThrow('The tolerance of weights');
    expect(run([3]).document).not.toBe(document);
  });
});

describe('times that were typed', () => {
  it('typed times are the transport’s, and converted to the take’s', () => {
    const given = typed({ rate: 10, from: 0, to: 1, tangents: 'linear' });
    expect(bakeArguments(walker, [3], given)).toEqual({ characterId: 'c1', channels: [3], from: 0.25, to: 1.25 });
    expect(resampleArguments(walker, [3], given)).toMatchObject({ from: 0.25, to: 1.25, tangents: 'linear' });
  });

  it('frames of typed times are the transport’s: new keys are on them', () => {
    const args = resampleArguments(walker, [3], typed({ rate: 10, from: 0, to: 0.5, tangents: 'smooth' }));
    const [after] = resample.run(documentOf(walker), args).document.characters;
    const times = [...(keysOf(shownTake(after)?.channels[3]).times ?? [])].filter((t) => t >= 0.249 && t <= 0.751);
    expect(times.map((t) => Number((10 * (t - 0.25)).toFixed(9)))).toEqual([0, 1, 2, 3, 4, 5]);
  });
});

describe('what scaling is asked for', () => {
  it('the scale dialog asks for a pivot value per unit', () => {
    const keys = [
      { channel: 0, indices: [1] },
      { channel: 3, indices: [0, 1] },
      { channel: 7, indices: [2] },
    ];
    const answers = typed({ time: 2, pivot: 1, value: -1, angle: 180, length: 3, weight: 4 });
    const args = scaleArguments(walker, keys, answers, 'degrees');
    expect(args).toMatchObject({ pivotSeconds: 1.25, timeFactor: 2, valueFactor: -1, pivotValues: [3, Math.PI, 4] });
    expect(() => scaleKeys.run(documentOf(walker), args)).not.toThrow();
  });
});
