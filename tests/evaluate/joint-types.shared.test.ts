/** Skeletons of every joint type through the reader, against the reference's world matrices. */
import { expect, it } from 'vitest';
import { applyConstraints, compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { conformance, describeShared } from '../helpers/shared.ts';

interface JointTypes {
  readonly tolerance: number;
  readonly cases: readonly {
    readonly name: string;
    readonly skel: string;
    readonly dofs: readonly (readonly string[])[];
    readonly parents: readonly number[];
    readonly sets: readonly {
      readonly root_translation: readonly number[];
      readonly dofs: readonly number[];
      readonly world: readonly (readonly number[])[];
    }[];
  }[];
}

describeShared('joint types, against the reference', () => {
  const { tolerance, cases } = conformance<JointTypes>('joint-types.json');
  it.each(cases)('$name has the matrices of the reference', ({ skel, dofs, parents, sets }) => {
    const { value, diagnostics } = readSkel(skel, 'case.skel');
    expect(diagnostics.filter((d) => d.severity !== 'info')).toEqual([]);
    const [skeleton] = value ?? [];
    expect(skeleton.joints.map((joint) => joint.parent)).toEqual(parents);
    expect(skeleton.joints.map((joint) => dofsOf(joint.motion).map((dof) => dof.name))).toEqual(dofs);
    expect(readSkel(writeSkel(value ?? []).text, 'case.skel').value).toEqual(value);

    const compiled = compileSkeleton(skeleton);
    const first = compiled.firstDof[0];
    const pose = new Float64Array(first + compiled.dofCount);
    const world = new Float64Array(16 * compiled.jointCount);
    for (const set of sets) {
      pose.set(set.dofs, first);
      applyConstraints(compiled, pose, true);
      // It comes on top of what a root has of its own, after its limits.
      compiled.travel.forEach((dof, k) => {
        pose[dof] = set.root_translation[k] + (first ? 0 : pose[dof]);
      });
      worldMatrices(compiled, pose, world);
      const expected = set.world.flat();
      const off = expected.map((e, i) => Math.abs(world[i] - e) / Math.max(1, Math.abs(e)));
      expect(Math.max(...off)).toBeLessThanOrEqual(tolerance);
    }
  });
});
