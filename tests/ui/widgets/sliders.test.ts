import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { CharacterDof } from '../../../src/model/skeleton/dofs.ts';
import { lengthStep, reachOf } from '../../../src/model/skeleton/reach.ts';
import { UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { markLabel } from '../../../src/ui/editors/inspector/dof-mark.ts';
import { coupleText, limitText, sliderOptions, typedValues } from '../../../src/ui/editors/inspector/dof-rows.ts';
import { typedLimit } from '../../../src/ui/editors/rig/limit-editor.ts';
import { withoutNoise } from '../../../src/ui/state/joints/angles.ts';
import { clampSize } from '../../../src/ui/state/panels/splitter.ts';
import { exact, shown } from '../../../src/ui/widgets/numbers/number-text.ts';
import { numberTyped, refusalOf } from '../../../src/ui/widgets/numbers/slider.ts';
import { character, skeleton } from '../builders.ts';

const arm = character({ skeleton: skeleton(['hips', -1], ['arm', 0], ['hand', 1]) });
const rx: CharacterDof = { name: 'rx', unit: 'angle', rest: 0, joint: 0, limit: UNLIMITED, takesLimits: true };
const limited: CharacterDof = { ...rx, limit: { min: -Math.PI / 6, max: Math.PI / 4 } };

describe('sliderOptions', () => {
  it('spans a full turn without limits, in the unit that is shown', () => {
    expect(sliderOptions(rx, arm, 'degrees').span).toEqual([-180, 180]);
    expect(sliderOptions(rx, arm, 'radians').span?.[1]).toBeCloseTo(Math.PI, 12);
    expect(sliderOptions(rx, arm, 'degrees').bounds).toBeUndefined();
  });

  it('spans the limits while they hold, and lets nothing else be typed', () => {
    expect(sliderOptions(limited, arm, 'degrees')).toMatchObject({
      span: [-30, 45],
      bounds: [-30, 45],
      limits: [-30, 45],
    });
  });

  it('spans a full turn with the limits marked while they don’t', () => {
    const free = { ...arm, clampsToLimits: false };
    const options = sliderOptions(limited, free, 'degrees');
    expect(options).toMatchObject({ span: [-180, 180], limits: [-30, 45] });
    expect(options.bounds).toBeUndefined();
  });

  it('spans twice the size for a scale, and from −1 to 1 for other factors', () => {
    const factor: CharacterDof = { ...rx, name: 'sx', unit: 'factor', rest: 1 };
    expect(sliderOptions(factor, arm, 'degrees').span).toEqual([0, 2]);
    expect(sliderOptions({ ...factor, name: 'qw' }, arm, 'degrees').span).toEqual([-1, 1]);
    expect(sliderOptions({ ...factor, limit: { min: 0.5, max: 3 } }, arm, 'degrees')).toMatchObject({
      span: [0.5, 3],
      bounds: [0.5, 3],
    });
  });

  it('shows a DOF that is locked by its limits', () => {
    const locked = sliderOptions({ ...rx, limit: { min: 0, max: 0 } }, arm, 'degrees');
    expect(locked).toMatchObject({ span: [-180, 180], bounds: [0, 0], limits: [0, 0] });
  });

  it('sliderOptions takes crossed limits for none', () => {
    const crossed = { ...rx, limit: { min: 1, max: -1 } };
    expect(sliderOptions(crossed, arm, 'degrees')).toMatchObject({ span: [-180, 180] });
    expect(limitText(crossed, arm, 'radians')).toContain('reversed');
  });

  it('spans the character’s reach for lengths, and 0 to 1 for weights', () => {
    expect(sliderOptions({ ...rx, unit: 'length' }, arm, 'degrees').span).toEqual([-2, 2]);
    expect(sliderOptions({ ...rx, unit: 'weight' }, arm, 'degrees').span).toEqual([0, 1]);
  });
});

it('steps lengths by a hundredth of the reach, as a power of ten', () => {
  expect([lengthStep(arm.skeleton), lengthStep(undefined)]).toEqual([0.01, 0.01]);
});

it('bears a limit on one side alone', () => {
  const above = { ...rx, limit: { min: -Math.PI / 6, max: UNLIMITED.max } };
  const below = { ...rx, limit: { min: UNLIMITED.min, max: Math.PI / 4 } };
  expect(sliderOptions(above, arm, 'degrees').span).toEqual([-30, 180]);
  expect(sliderOptions(below, arm, 'degrees').span).toEqual([-180, 45]);
  expect(sliderOptions({ ...rx, limit: { min: 7, max: UNLIMITED.max } }, arm, 'radians').span?.[1]).toBeGreaterThan(7);
  expect(limitText(above, arm, 'degrees')).toBe('limits from −30°');
  expect(limitText(below, arm, 'degrees')).toBe('limits up to 45°');
});

describe('coupleText', () => {
  it('says what a DOF follows, in the units that are shown', () => {
    const couple = { dof: 6, follows: 3, gain: 0.5, offset: Math.PI / 18 };
    expect(coupleText(couple, rx, arm, 'degrees')).toBe('linked to 0.5 · rx of hips + 10°');
    expect(coupleText({ ...couple, offset: 0 }, rx, arm, 'radians')).toBe('linked to 0.5 · rx of hips');
    const length: CharacterDof = { ...rx, name: 't', unit: 'length' };
    expect(coupleText({ ...couple, gain: 1 }, length, arm, 'degrees')).toBe('linked to 0.017 · rx of hips + 0.175');
  });
});

describe('a typed number that is not taken', () => {
  const held = sliderOptions(limited, arm, 'degrees');

  it('a typed number that is not taken is told the limit that it is beyond, and what holds it', () => {
    expect(refusalOf('rx of arm', '90', held)).toBe(
      'rx of arm can’t go above 45°; you entered 90°. Turn off Enforce limits in the Edit menu to go past it.',
    );
    expect(refusalOf('rx of arm', '-31', held)).toContain('can’t go below −30°');
    expect(refusalOf('rate', '9', { bounds: [-4, 4], step: 1, decimals: 1, suffix: '×' })).toBe(
      'rate can’t go above 4×; you entered 9×.',
    );
  });

  it('a typed number that is not taken is told that a DOF is locked', () => {
    const locked = sliderOptions({ ...rx, limit: { min: 0, max: 0 } }, arm, 'degrees');
    expect(refusalOf('rx', '30', locked)).toMatch(/^rx is limited to 0°; you entered 30°/);
  });

  it('a typed number that is not taken is told that it is none', () => {
    expect(refusalOf('rx', 'ten', held)).toBe('rx: “ten” is not a number.');
  });

  it('a typed number that is not taken is none of those within the limits, or where there are none', () => {
    expect(refusalOf('rx', '45,0', held)).toBeUndefined();
    expect(refusalOf('rx', '900', sliderOptions(rx, arm, 'degrees'))).toBeUndefined();
  });
});

it('names the DOF of a mark to who can’t see its row', () => {
  expect(markLabel('driven', 'rx of leg_fl')).toBe('Key rx of leg_fl');
  expect(markLabel('keyed', 'rx of leg_fl')).toBe('Delete key of rx of leg_fl at current time');
});

it('reads typed limits: a number, or nothing for no limit', () => {
  expect(typedLimit('-90', '45', 180 / Math.PI)).toEqual({ min: -Math.PI / 2, max: Math.PI / 4 });
  expect(typedLimit('', ' 2 ', 1)).toEqual({ min: UNLIMITED.min, max: 2 });
  expect(typedLimit('0', '', 1)).toEqual({ min: 0, max: UNLIMITED.max });
  expect(typedLimit('', '', 1)).toEqual(UNLIMITED);
  expect(typedLimit('two', '', 1)).toContain('number');
  expect(typedLimit('2', '1', 1)).toContain('above');
});

it('has a reach for anything', () => {
  expect(reachOf(arm.skeleton)).toBe(2);
  expect(reachOf(undefined)).toBe(1);
  expect(reachOf({ name: 'none', joints: [] })).toBe(1);
});

it('says what limits there are', () => {
  expect(limitText(limited, arm, 'degrees')).toBe('limits −30° to 45°');
  expect(limitText(limited, { clampsToLimits: false }, 'degrees')).toBe('limits −30° to 45°, not enforced');
  expect(limitText(rx, arm, 'degrees')).toBe('no limits');
});

it('keeps panels at a usable size', () => {
  expect(clampSize('outlinerWidth', 3)).toBe(180);
  expect(clampSize('outlinerWidth', 300.4)).toBe(300);
  expect(clampSize('inspectorWidth', 9999)).toBe(640);
});

describe('a typed number', () => {
  const degrees = { decimals: 2, units: { '°': 1 } };

  it('a typed number that is what is shown changes nothing, to the last digit shown', () => {
    for (const text of ['39.63', '39.63°', ' 39.63 ', '39,63', '+=0']) {
      expect(numberTyped(text, 39.6341276, degrees), text).toBe(39.6341276);
    }
    expect(numberTyped('39.64', 39.6341276, degrees)).toBe(39.64);
    expect(numberTyped('39.6', 39.6341276, degrees)).toBe(39.6);
    expect(numberTyped('ten', 39.6341276, degrees)).toBeUndefined();
  });

  it('a typed number with more digits than are shown is exact', () => {
    expect(numberTyped('39.630', 39.6341276, degrees)).toBe(39.63);
    expect(numberTyped('0', 0.004, degrees)).toBe(0.004);
    expect(numberTyped('0.000', 0.004, degrees)).toBe(0);
  });

  it('a DOF keeps its very number when the displayed one is typed, rounded or not', () => {
    fc.assert(
      fc.property(fc.double({ min: -4, max: 4, noNaN: true }), fc.constantFrom(1, 180 / Math.PI), (value, perUnit) => {
        const displayed = withoutNoise(value * perUnit);
        for (const text of [exact(displayed), shown(displayed, 2)]) {
          const typed = typedValues({ text, from: displayed }, [value], { index: 0 }, [0], perUnit, { decimals: 2 });
          expect(typed).toEqual([{ index: 0, value }]);
        }
      }),
    );
  });
});
