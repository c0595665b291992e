import { expect, it } from 'vitest';
import { checkOf, flagsOf } from '../../src/cli/export/take-check.ts';
import { loadFiles, openLoaded } from '../../src/cli/load.ts';
import { FloatPool } from '../../src/dataset/float-pool.ts';
import { type TakeOptions, takeOf } from '../../src/dataset/take.ts';
import { takeArrays } from '../../src/dataset/take-arrays.ts';
import type { Character } from '../../src/model/document.ts';
import { flagText } from '../../src/review/flags.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

const NARROW = { min: -0.1, max: 0.1 };

function opened(name: string): Character {
  return openLoaded(loadFiles([sharedPath(`data/bvh/${name}`)], '/')).document.characters[0];
}

function flagsInPassing(read: Character, options: TakeOptions = {}): readonly string[] | undefined {
  const take = takeOf(read, options);
  const check = checkOf(take, read);
  takeArrays(take, new FloatPool('float32'), check);
  return check?.end().map(flagText);
}

describeShared('checks of exported takes', () => {
  it.each(['perception-neuron-course.bvh', 'cmu-01_01.bvh', 'xsens-armchair.bvh'])(
    'frames given in passing have the flags of a pass of their own: %s',
    (name) => {
      const read = opened(name);
      expect(flagsInPassing(read)).toEqual(flagsOf(takeOf(read, {}), read));
    },
  );

  it('a part of a take has the flags of all of it', () => {
    const read = opened('perception-neuron-course.bvh');
    const flags = flagsInPassing(read, { crop: { from: 1, to: 2 } });
    expect(flags).toEqual(flagsOf(takeOf(read, {}), read));
    expect(flags).not.toEqual([]);
  });

  it('a mirrored take has the flags of the other side', () => {
    const read = opened('perception-neuron-course.bvh');
    const mirrored = flagsOf(takeOf(read, { isMirrored: true }), read);
    const exchanged = mirrored.map((flag) =>
      flag.replace(/Left|Right/, (side) => (side === 'Left' ? 'Right' : 'Left')),
    );
    const sided = (flags: readonly string[]) => flags.filter((flag) => /Left|Right/.test(flag)).sort();
    expect(sided(mirrored)).not.toEqual([]);
    expect(sided(exchanged)).toEqual(sided(flagsOf(takeOf(read, {}), read)));
  });

  it('a retargeted take has the flags of the result: of joints of the target, and its own when it is the target', () => {
    const read = opened('perception-neuron-course.bvh');
    const own = flagsOf(takeOf(read, {}), read);
    const kinds = (flags: readonly string[]) => flags.map((flag) => flag.split(' ')[0]);
    expect(kinds(flagsOf(takeOf(read, { target: { character: { ...read, id: 'c2' } } }), read))).toEqual(kinds(own));
    // A jump of the root comes through; what was odd about the bones of the source doesn't, but that a leg whose length
    // changes for two frames turns the target's instead.
    const [take] = read.takes;
    const values = take.samples?.values.slice() ?? new Float64Array(0);
    values[60 * (take.samples?.scales.length ?? 0)] += 100;
    const jumping = { ...read, takes: [{ ...take, ...(take.samples && { samples: { ...take.samples, values } }) }] };
    const target = { character: { ...opened('cmu-01_01.bvh'), id: 'c2' } };
    expect(flagsOf(takeOf(jumping, { target }), jumping)).toEqual([
      expect.stringMatching(/^slide 0.* RightToeBase$/),
      'spike 0.48 Hips',
      'spike 1.848 RightUpLeg',
    ]);
  });

  it('frames other than those that were read are checked by a pass of their own', () => {
    const read = opened('cmu-01_01.bvh');
    for (const options of [{ isMirrored: true }, { isRaw: true }, { fps: 7 }]) {
      expect(flagsInPassing(read, options)).toBeUndefined();
    }
  });

  it('limits are checked on the values as read, whether or not poses are kept within them', () => {
    const read = opened('cmu-01_01.bvh');
    const joints = read.skeleton?.joints.map((joint) => ({ ...joint, limits: joint.limits.map(() => NARROW) })) ?? [];
    const limited: Character = { ...read, skeleton: { name: '', joints } };
    const free = flagsInPassing({ ...limited, clampsToLimits: false });
    expect(free?.filter((flag) => flag.startsWith('limit'))).not.toEqual([]);
    expect(free).toEqual(flagsOf(takeOf(limited, {}), limited));
    expect(flagsInPassing({ ...limited, clampsToLimits: true })).toBeUndefined();
  });
});
