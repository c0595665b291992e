/** Skeletons of twenty thousand joints, in a chain and in a star: posed, edited, undone, saved and read again. */
import { describe, expect, it } from 'vitest';
import { setDofs } from '../../src/edit/commands/pose.ts';
import { renameJoint } from '../../src/edit/commands/rig-joint.ts';
import { Store } from '../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { saveCharacter } from '../../src/files/save/saving.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import type { Joint } from '../../src/model/skeleton/skeleton.ts';
import { read } from '../formats/read-in-pieces.ts';
import { character, documentOf, joint } from '../helpers/builders.ts';

const MANY = 20_000;
const SHAPES: readonly (readonly [string, (j: number) => number])[] = [
  ['chain', (j) => j - 1],
  ['star', (j) => (j === 0 ? -1 : 0)],
];

describe('a skeleton of twenty thousand joints', () => {
  it.each(SHAPES)('a %s of twenty thousand joints is posed, renamed, undone, saved and read again', (_, parentOf) => {
    const like = joint(-1, { offset: [0, 1, 0] });
    const joints = Array.from({ length: MANY }, (_, j): Joint => ({ ...like, parent: parentOf(j) }));
    const skeleton = { name: 'large', joints };
    const document = documentOf(character({ skeleton, pose: filePose(skeleton, 0) }));
    const store = new Store(document);
    store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 0.5 }], timeSeconds: 0 });
    store.apply(renameJoint, { characterId: 'c1', joint: MANY - 1, name: 'last' });
    const [edited] = store.document.characters;
    const world = new Float64Array(16 * MANY);
    worldMatrices(compileSkeleton(edited.skeleton ?? skeleton), Float64Array.from(edited.pose), world);
    expect(world.every(Number.isFinite)).toBe(true);
    const [file] = saveCharacter(edited, 'skel');
    const { value } = read(file.name, file.text);
    expect(value?.kind === 'skel' && value.skeletons[0].joints.at(-1)?.name).toBe('last');
    expect([store.undo(), store.undo()]).toEqual([true, true]);
    expect(store.document).toBe(document);
  });
});
