import { describe, expect, it } from 'vitest';
import { poseByNames, takePose } from '../../../src/edit/pose/by-names.ts';
import { addPoses, freePoseName, nextPoseName } from '../../../src/edit/pose/library.ts';
import { withSkeleton } from '../../../src/edit/with-skeleton.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { characterDofs } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import type { Joint, Motion } from '../../../src/model/skeleton/skeleton.ts';
import { character, documentOf, file, joint, morph } from '../../helpers/builders.ts';

const named = (parent: number, name: string, motion?: Motion): Joint => {
  if (!motion) return joint(parent, { name });
  const dofs = dofsOf(motion);
  return joint(parent, { name, motion, pose: dofs.map((d) => d.rest), limits: dofs.map(() => ({ min: -9, max: 9 })) });
};
const hinge: Motion = { kind: 'hinge', axis: [1, 0, 0] };
const hero = character({
  skeleton: { name: 'hero', joints: [named(-1, 'hip'), named(0, 'knee', hinge), named(1, 'foot')] },
  morphs: [morph('smile')],
});
const count = characterDofs(hero.skeleton, hero.morphs).length;
const values = Array.from({ length: count }, (_, d) => d / 10 + 0.1);

describe('a pose by names', () => {
  it('a pose by names comes back onto the same skeleton exactly', () => {
    const { values: taken, missing } = takePose(hero, poseByNames(hero, { name: 'a', values }));
    expect(taken).toEqual(new Map(values.entries()));
    expect(missing).toEqual([]);
  });

  it('applies to one with the same names in another order, or spelled differently', () => {
    const other = character({
      skeleton: { name: 'o', joints: [named(-1, 'mixamorig:Hip'), named(0, 'foot'), named(0, 'KNEE', hinge)] },
    });
    const { values: taken, found, missing } = takePose(other, poseByNames(hero, { name: 'a', values }));
    // 3 of the root, 3 of hip, 3 of foot, 1 of knee.
    expect([...taken.entries()].sort((a, b) => a[0] - b[0]).map(([, v]) => v)).toEqual([
      ...values.slice(0, 6),
      ...values.slice(7, 10),
      values[6],
    ]);
    expect([found, missing]).toEqual([3, []]);
  });

  it('skips joints that do not exist, or whose DOFs have other names', () => {
    const other = character({
      skeleton: { name: 'o', joints: [named(-1, 'hip', { kind: 'quaternion' }), named(0, 'knee', hinge)] },
    });
    const { values: taken, missing } = takePose(other, poseByNames(hero, { name: 'a', values }));
    expect(missing).toEqual(['hip', 'foot']);
    expect([...taken.keys()].sort((a, b) => a - b)).toEqual([0, 1, 2, 7]);
  });

  it('takes joints of one name in their order', () => {
    const twins = character({
      skeleton: { name: 't', joints: [named(-1, 'a'), named(0, 'b', hinge), named(0, 'b', hinge), named(0, 'c')] },
    });
    const pose = poseByNames(twins, { name: 'a', values: [0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0] });
    const fewer = character({
      skeleton: { name: 'u', joints: [named(-1, 'a'), named(0, 'b', hinge), named(0, 'b', hinge)] },
    });
    const { values: taken } = takePose(fewer, pose);
    expect([taken.get(6), taken.get(7)]).toEqual([1, 2]);
  });

  it('a pose by names is at rest if it has no value', () => {
    const pose = poseByNames(hero, { name: 'a', values: [1] });
    expect(pose.root).toEqual([1, 0, 0]);
    expect(pose.joints.flatMap(({ dofs }) => dofs.map((d) => d.value))).toEqual([0, 0, 0, 0, 0, 0, 0]);
  });
});

describe('the library', () => {
  it('numbers poses, and names that are taken', () => {
    expect(nextPoseName([])).toBe('pose 1');
    expect(nextPoseName([{ name: 'pose 2', values: [] }])).toBe('pose 3');
    expect(freePoseName([{ name: 'sit', values: [] }], 'sit')).toBe('sit 2');
    expect(
      freePoseName(
        [
          { name: 'sit', values: [] },
          { name: 'sit 2', values: [] },
        ],
        'sit 2',
      ),
    ).toBe('sit 3');
  });

  it('the library is carried over when the skeleton’s file is opened again with other joints', () => {
    const kept = addPoses(hero, [poseByNames(hero, { name: 'sit', values })]);
    const joints = [named(-1, 'hip'), named(0, 'tail', hinge), named(0, 'knee', hinge), named(2, 'foot')];
    const after = withSkeleton(kept, { name: 'hero', joints });
    expect(after.poses?.[0].values).toEqual([...values.slice(0, 6), 0, ...values.slice(6)]);
  });

  it('takes a pose that it has already once', () => {
    const pose = poseByNames(hero, { name: 'sit', values });
    const once = addPoses(hero, [pose]);
    expect(once.poses?.map(({ name }) => name)).toEqual(['sit']);
    expect(addPoses(once, [pose])).toBe(once);
    const other = addPoses(once, [poseByNames(hero, { name: 'sit', values: [1] })]);
    expect(other.poses?.map(({ name }) => name)).toEqual(['sit', 'sit 2']);
  });
});

describe('a .pose that is opened', () => {
  const other = character({
    id: 'c2',
    name: 'crab',
    skeleton: { name: 'crab', joints: [named(-1, 'shell'), named(0, 'claw')] },
  });
  const poses = file('kept.pose', { kind: 'pose', poses: [poseByNames(hero, { name: 'sit', values })] });
  const open = (document = documentOf(other, { ...hero, id: 'c1' }), selected?: string) =>
    openFiles(document, [poses], [], selected);

  it('a .pose that is opened is added to the library of the character that has its joints, whichever is selected', () => {
    for (const selected of [undefined, 'c1', 'c2']) {
      const { document, opened, diagnostics, label } = open(undefined, selected);
      expect(opened).toEqual(['c1']);
      expect(document.characters.map((c) => c.poses?.map((p) => p.name))).toEqual([undefined, ['sit']]);
      expect(document.characters[1].poses?.[0].values).toEqual(values);
      expect(diagnostics).toEqual([]);
      expect(label).toBe('Open kept.pose');
    }
  });

  it('a .pose that is opened is added to the selected one of several that have them', () => {
    const twin = { ...hero, id: 'c3', name: 'twin' };
    expect(open(documentOf(hero, twin), 'c3').opened).toEqual(['c3']);
  });

  it('waits if no character has them, and is added to the first that comes', () => {
    const { document, diagnostics } = open(documentOf(other));
    expect(document.unused).toHaveLength(1);
    expect(diagnostics.map((d) => d.code)).toEqual(['file-unused']);
    const skel = file('hero.skel', { kind: 'skel', skeletons: [hero.skeleton ?? { name: '', joints: [] }] });
    const next = openFiles(document, [skel]);
    expect(next.document.unused).toEqual([]);
    expect(next.document.characters[1].poses?.[0].name).toBe('sit');
  });

  it('says which of its joints are not there', () => {
    const legless = { ...hero, skeleton: { name: 'h', joints: [named(-1, 'hip'), named(0, 'knee', hinge)] } };
    const { diagnostics } = open(documentOf(legless));
    expect(diagnostics.map((d) => [d.severity, d.code])).toEqual([['warning', 'pose-joint-missing']]);
    expect(diagnostics[0].message).toContain('"foot"');
  });
});
