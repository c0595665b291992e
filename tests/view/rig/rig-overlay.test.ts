import { InstancedMesh, PerspectiveCamera } from 'three';
import { describe, expect, it } from 'vitest';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { RigOverlay, type RigPicture } from '../../../src/view/rig/rig-overlay.ts';
import { skeleton } from '../../ui/builders.ts';

const IDENTITY = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);

/** Joints are a unit apart along x; the second instance is a unit higher. */
function picture(of: Skeleton, copy = 0): RigPicture {
  const world = new Float64Array(16 * of.joints.length);
  for (const j of of.joints.keys()) {
    world.set(IDENTITY, 16 * j);
    world[16 * j + 12] = j;
  }
  const placement = IDENTITY.slice();
  placement[13] = copy;
  const look = { selected: undefined, others: [], axes: 'parent', withArrows: false } as const;
  return { skeleton: of, world: () => world, dofs: () => new Float64Array(0), placement: () => placement, ...look };
}

function camera(): PerspectiveCamera {
  const made = new PerspectiveCamera(90, 1, 0.1, 100);
  made.position.z = 2;
  made.updateMatrixWorld();
  return made;
}

/** Render order of the dots at the selected joints, and at the active one. */
const [OTHERS, ACTIVE] = [46, 47];

/** Of the first nodes, in whole pixels. */
const places = ({ screen }: RigOverlay, count: number) =>
  screen && Array.from(screen.nodes.subarray(0, 2 * count), Math.round);

describe('handles of a rig', () => {
  it('handles of a rig are where the next picture has them as soon as another is shown', () => {
    const overlay = new RigOverlay();
    const two = skeleton(['root', -1], ['joint1', 0]);
    overlay.show(picture(two));
    expect(overlay.screen).toBeUndefined();
    const seenBy = camera();
    overlay.update(seenBy, 400);
    expect(places(overlay, 2)).toEqual([200, 200, 300, 200]);

    overlay.show(picture(skeleton(['root', -1], ['joint1', 0], ['joint2', 1])));
    expect(places(overlay, 3)).toEqual([200, 200, 300, 200, 400, 200]);
    overlay.show(picture(two, 1));
    expect(places(overlay, 2)).toEqual([200, 100, 300, 100]);
    seenBy.position.y = 1;
    expect(places(overlay, 2)).toEqual([200, 200, 300, 200]);
    overlay.show(undefined);
    expect(overlay.screen).toBeUndefined();
    overlay.dispose();
  });

  it('handles of a rig mark every selected joint that exists, apart from the active one', () => {
    const overlay = new RigOverlay();
    const of = skeleton(['root', -1], ['joint1', 0], ['joint2', 1], ['joint3', 2]);
    const marks = () =>
      overlay.object.children
        .filter((mesh): mesh is InstancedMesh => mesh instanceof InstancedMesh)
        .filter(({ renderOrder }) => renderOrder === OTHERS || renderOrder === ACTIVE)
        .map(({ renderOrder, count }) => [renderOrder, count]);
    overlay.show({ ...picture(of), selected: 3, others: [0, 2, 9] });
    overlay.update(camera(), 400);
    expect(marks()).toEqual([
      [OTHERS, 2],
      [ACTIVE, 1],
    ]);
    overlay.show({ ...picture(of), selected: 3 });
    overlay.update(camera(), 400);
    expect(marks()).toEqual([
      [OTHERS, 0],
      [ACTIVE, 1],
    ]);
    overlay.dispose();
  });

  it('a handle of a small box that would cover the joint is left out, and those of a large one are all there', () => {
    const handles = (half: number) => {
      const overlay = new RigOverlay();
      const [root] = skeleton(['root', -1]).joints;
      const box = { min: [-half, -half, -half], max: [half, half, half] } as const;
      overlay.show({ ...picture({ ...skeleton(['root', -1]), joints: [{ ...root, box }] }), selected: 0 });
      overlay.update(camera(), 400);
      const faces = Array.from(overlay.screen?.faces ?? []);
      overlay.dispose();
      return [0, 1, 2, 3, 4, 5].filter((face) => Number.isFinite(faces[2 * face]));
    };
    // 60 pixels wide: the front and the back face are at the joint.
    expect(handles(0.3)).toEqual([0, 1, 2, 3]);
    // 20 pixels: all overlap.
    expect(handles(0.1)).toEqual([]);
  });
});
