import { Matrix4, type Object3D, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { type ComparedSide, ComparedSkeleton, type JointVerdict } from '../../../src/view/compare/compared-skeleton.ts';
import { AGREES, INHERITED, LIT, NO_LOOK, OWN, THEIRS } from '../../../src/view/compare/node-looks.ts';
import { nodesFor, sizesFor } from '../../../src/view/skeleton/drawn-skeletons.ts';
import { NodeMesh } from '../../../src/view/skeleton/node-buffer.ts';
import { personSkeleton } from '../../helpers/mocap.ts';

/** Floats, for a character some 170 units high. */
const SAME = 1e-3;

const skeleton = personSkeleton();
const nodes = nodesFor(skeleton);
const [HIPS, HEAD, LEG, FOOT] = [0, 1, 2, 3];
const ours = new Float64Array(16 * nodes.jointCount);
worldMatrices(compileSkeleton(skeleton), Float64Array.from(filePose(skeleton, 0)), ours);
const placement = new Matrix4().makeRotationY(0.7).setPosition(3, 4, 5);
const placements = Float64Array.from([...new Matrix4().elements, ...placement.elements]);

/** Theirs: the left leg and all below it moved, and the foot's ball with it. */
function moved(): Float64Array {
  const theirs = ours.slice();
  for (const joint of [LEG, FOOT]) theirs[16 * joint + 12] += 40;
  return theirs;
}
const VERDICTS: readonly JointVerdict[] = ['agrees', 'agrees', 'own', 'inherited', 'agrees', 'agrees'];

interface Instance {
  readonly look: number;
  readonly at: Vector3;
  readonly radius: number;
}

function instancesOf(object: Object3D, shape: 'ball' | 'bone'): Instance[] {
  const found: Instance[] = [];
  object.traverseVisible((mesh) => {
    if (!(mesh instanceof NodeMesh) || mesh.shape !== shape) return;
    const matrix = new Matrix4();
    for (let i = 0; i < mesh.count; i++) {
      mesh.getMatrixAt(i, matrix);
      found.push({
        look: mesh.geometry.getAttribute('look').getX(i),
        at: new Vector3().setFromMatrixPosition(matrix),
        radius: new Vector3().setFromMatrixColumn(matrix, 0).length(),
      });
    }
  });
  return found;
}

function drawn(side: ComparedSide, theirs = moved(), placementCount = 1) {
  const compared = new ComparedSkeleton();
  compared.show({ skeleton, verdicts: VERDICTS, ours, theirs, tolerance: 0.01 }, side, placementCount);
  compared.fill(ours, placements);
  const [own, ghost] = compared.object.children;
  return { compared, own, ghost };
}

const originOf = (world: Float64Array, joint: number) => new Vector3().fromArray(world, 16 * joint + 12);

describe('a compared skeleton', () => {
  it('balls look like the verdict of their joint, bones like that of the joint where they start', () => {
    const { own } = drawn('ours');
    const balls = instancesOf(own, 'ball');
    const bones = instancesOf(own, 'bone');
    expect(balls.slice(0, 6).map(({ look }) => look)).toEqual([AGREES, AGREES, OWN, INHERITED, AGREES, AGREES]);
    expect(bones[LEG].look).toBe(AGREES);
    expect(bones[FOOT].look).toBe(OWN);
    expect(bones[HIPS].look).toBe(NO_LOOK);
    // The End Sites of head and feet.
    expect(balls.slice(6).map(({ look }) => look)).toEqual([AGREES, INHERITED, AGREES]);
    expect(bones.slice(6).map(({ look }) => look)).toEqual([AGREES, INHERITED, AGREES]);
    expect(balls[LEG].at.distanceTo(originOf(ours, LEG))).toBeLessThan(SAME);
  });

  it('the joint under the pointer is lit, with the bones that start there, at its placement', () => {
    const { compared, own } = drawn('ours', moved(), 2);
    compared.hover({ joint: LEG, placement: 1 });
    const lit = (shape: 'ball' | 'bone') =>
      instancesOf(own, shape).flatMap(({ look }, i) => (look >= LIT ? [[i, look - LIT]] : []));
    expect(lit('ball')).toEqual([[nodes.count + LEG, OWN]]);
    expect(lit('bone')).toEqual([[nodes.count + FOOT, OWN]]);
    compared.hover(undefined);
    expect([...lit('ball'), ...lit('bone')]).toEqual([]);
  });

  it('wrong joints are thicker, so that they are told apart without colours', () => {
    const balls = instancesOf(drawn('ours').own, 'ball');
    const { radii } = sizesFor(skeleton);
    const thick = (joint: number) => balls[joint].radius / radii[joint];
    expect(thick(LEG)).toBeGreaterThan(1.2 * thick(FOOT));
    expect(thick(FOOT)).toBeGreaterThan(1.2 * thick(HEAD));
  });

  it('beside ours the ghost has only what is elsewhere, alone it has all', () => {
    const both = drawn('both').ghost;
    expect(instancesOf(both, 'ball').map(({ look }) => look)).toEqual([0, 0, THEIRS, THEIRS, 0, 0, 0, THEIRS, 0]);
    expect(instancesOf(both, 'bone').map(({ look }) => look)).toEqual([0, 0, THEIRS, THEIRS, 0, 0, 0, THEIRS, 0]);
    const { own, ghost } = drawn('theirs');
    expect(own.visible).toBe(false);
    expect(instancesOf(ghost, 'ball').every(({ look }) => look === THEIRS)).toBe(true);
    expect(drawn('ours').ghost.visible).toBe(false);
  });

  it('the ghost is where the other program has its joints, at every placement of the character', () => {
    const theirs = moved();
    const balls = instancesOf(drawn('theirs', theirs, 2).ghost, 'ball');
    expect(balls).toHaveLength(2 * nodes.count);
    for (let joint = 0; joint < nodes.jointCount; joint++) {
      const at = originOf(theirs, joint);
      expect(balls[joint].at.distanceTo(at)).toBeLessThan(SAME);
      expect(balls[nodes.count + joint].at.distanceTo(at.applyMatrix4(placement))).toBeLessThan(SAME);
    }
  });

  it('positions have no bone ends, since those follow from orientations', () => {
    const positions = Float64Array.from({ length: 3 * nodes.jointCount }, (_, i) => {
      return moved()[16 * Math.floor(i / 3) + 12 + (i % 3)];
    });
    const { ghost } = drawn('theirs', positions);
    const balls = instancesOf(ghost, 'ball');
    expect(balls.map(({ look }) => look)).toEqual([...Array(6).fill(THEIRS), 0, 0, 0]);
    expect(balls[FOOT].at.distanceTo(originOf(moved(), FOOT))).toBeLessThan(SAME);
  });

  it('joints that are no numbers are not drawn, nor the bones from and to them', () => {
    const theirs = moved();
    theirs[16 * LEG + 13] = Number.NaN;
    const { ghost } = drawn('theirs', theirs);
    const without = (n: number) => (n === LEG || n === FOOT ? NO_LOOK : THEIRS);
    expect(instancesOf(ghost, 'ball').map(({ look }) => look)).toEqual(
      Array.from({ length: nodes.count }, (_, n) => (n === LEG ? NO_LOOK : THEIRS)),
    );
    expect(instancesOf(ghost, 'bone').map(({ look }) => look)).toEqual([
      NO_LOOK,
      ...Array.from({ length: nodes.count - 1 }, (_, n) => without(n + 1)),
    ]);
  });

  it('follows ours as they move, and the ghost stays', () => {
    const { compared, own, ghost } = drawn('both');
    const before = instancesOf(ghost, 'ball')[LEG].at;
    const later = ours.slice();
    for (let j = 0; j < nodes.jointCount; j++) later[16 * j + 13] += 25;
    compared.fill(later, placements);
    expect(instancesOf(own, 'ball')[HEAD].at.distanceTo(originOf(later, HEAD))).toBeLessThan(SAME);
    expect(instancesOf(ghost, 'ball')[LEG].at.distanceTo(before)).toBe(0);
  });

  it('is gone when nothing is compared, and frees its geometries and materials', () => {
    const { compared } = drawn('both', moved(), 2);
    const freed = new Set<unknown>();
    const all = new Set<unknown>();
    compared.object.traverse((mesh) => {
      if (!(mesh instanceof NodeMesh)) return;
      for (const part of [mesh.geometry, mesh.material].flat()) {
        all.add(part);
        part.addEventListener('dispose', () => freed.add(part));
      }
    });
    compared.show(undefined, 'both', 0);
    expect(compared.object.visible).toBe(false);
    compared.dispose();
    expect(freed).toEqual(all);
    expect(all.size).toBe(8);
  });
});
