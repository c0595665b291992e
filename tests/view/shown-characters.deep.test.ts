import { Box3, Euler, Group, Matrix4, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { fitEye, lookingFrom } from '../../src/math/framing.ts';
import { DEFAULT_DISPLAY } from '../../src/model/session.ts';
import { CharacterView } from '../../src/view/character-view.ts';
import { Grid } from '../../src/view/scene/grid.ts';
import { framedTimes, ShownCharacters } from '../../src/view/shown-characters.ts';
import { DrawnSkins } from '../../src/view/skin/drawn-skins.ts';
import { character, documentOf, joint, skin } from '../helpers/builders.ts';
import { sharedCaptures } from '../helpers/bvh-files.ts';
import { heatValuesOf } from '../helpers/heat-values.ts';
import { captured, personSkeleton, takeOfRoots } from '../helpers/mocap.ts';
import { describeShared } from '../helpers/shared.ts';

const skeleton = personSkeleton();
const space = { up: 'y', unit: 'centimetres', lift: 0 } as const;
const near = captured(skeleton, takeOfRoots(skeleton, [[0, 85, 0]]), { id: 'near', space });
const far = captured(skeleton, takeOfRoots(skeleton, [[1000, 85, 0]]), { id: 'far', space });

function shown(...characters: (typeof near)[]): ShownCharacters {
  const all = new ShownCharacters(
    new Group(),
    () => new CharacterView(new DrawnSkins()),
    () => {},
  );
  all.show(documentOf(...characters), DEFAULT_DISPLAY, {}, 0, true);
  all.place(false);
  return all;
}

describe('the characters in the picture', () => {
  it('the characters in the picture are framed where they stand, in metres', () => {
    const { content } = shown(near, far);
    expect(content.max.y).toBeCloseTo(1.7, 6);
    expect(content.min.y).toBeCloseTo(0, 6);
    expect(content.max.x).toBeCloseTo(10.102, 6);
  });

  it('the whole path of a walk is framed, back and forth, however many frames it has', () => {
    // 30 m away and back within a tenth of the take, and 12 m to the side.
    const walk = Array.from({ length: 5001 }, (_, f): [number, number, number] => {
      const away = Math.max(0, 1 - Math.abs(f - 3000) / 250);
      return [3000 * away, 85, 1200 * Math.sin(f / 300)];
    });
    const take = takeOfRoots(skeleton, walk);
    const all = shown(captured(skeleton, take, { id: 'walker', space }));
    const framed = new Box3();
    for (const box of all.boundsOfMotion([0, 500], 0)) framed.union(box);
    expect(framed.max.x).toBeGreaterThan(29);
    expect(framed.min.z).toBeLessThan(-11.9);
    expect(framed.max.z).toBeGreaterThan(11.9);
    // The pose is the same as before.
    expect(all.get('walker')?.view.dofs[0]).toBe(0);
  });

  it('characters are posed for framing only if they move, and less often the more joints they have', () => {
    const poses = (all: ShownCharacters) => {
      let count = 0;
      for (const { view } of all.all) {
        const { seek } = view;
        view.seek = (...values) => {
          count++;
          seek.apply(view, values);
        };
      }
      all.boundsOfMotion([0, 1], 0);
      return count;
    };
    const moving = shown(near);
    expect(poses(moving)).toBeGreaterThan(100);
    expect(poses(shown({ ...near, takes: [], shownTake: -1 }))).toBe(0);
    const joints = Array.from({ length: 10_000 }, (_, j) => joint(j - 1));
    expect(poses(shown({ ...near, skeleton: { ...skeleton, joints } }))).toBeLessThan(80);
  });

  it('a character that a broken frame throws kilometres away is framed where it is', () => {
    const thrown = captured(
      skeleton,
      takeOfRoots(skeleton, [
        [0, 85, 0],
        [1e6, 85, 0],
      ]),
      { id: 'thrown', space },
    );
    for (const box of shown(thrown).boundsOfMotion([0, 0.1], 0)) expect(box.max.x).toBeLessThan(1);
  });

  it('hidden characters are neither drawn nor framed, and posed all the same', () => {
    const all = shown(near, { ...far, isHidden: true });
    expect(all.posedSkeletons(new Map()).map((p) => p.characterId)).toEqual(['near']);
    expect(all.content.max.x).toBeLessThan(1);
    expect(all.seen('far')).toBeUndefined();
    expect(all.get('far')?.view.object.visible).toBe(false);
    expect(all.get('far')?.view.dofs[0]).toBe(1000);
    all.show(documentOf(near, far), DEFAULT_DISPLAY, {}, 0, false);
    expect(all.posedSkeletons(new Map())).toHaveLength(2);
  });

  it('stand on the spot in place', () => {
    const all = shown(far);
    all.show(documentOf(far), { ...DEFAULT_DISPLAY, inPlace: true }, {}, 0, true);
    all.place(true);
    expect(all.content.max.x).toBeCloseTo(0.102, 6);
    expect(all.content.max.y).toBeCloseTo(1.7, 6);
  });

  it('stand still in place while they are dragged about, and on the spot again after it', () => {
    const display = { ...DEFAULT_DISPLAY, inPlace: true };
    const all = shown(far);
    all.show(documentOf(far), display, {}, 0, true);
    const view = all.get('far')?.view;
    view?.freezeRootMotion(true);
    const dragged = captured(skeleton, takeOfRoots(skeleton, [[1200, 85, 0]]), { id: 'far', space });
    all.show(documentOf(dragged), display, {}, 0, false);
    all.place(true);
    expect(all.content.max.x).toBeCloseTo(2.102, 6);
    expect(all.get('far')?.placements[12]).toBeCloseTo(-10, 6);
    view?.freezeRootMotion(false);
    all.place(true);
    expect(all.content.max.x).toBeCloseTo(0.102, 6);
    expect(all.get('far')?.placements[12]).toBeCloseTo(-12, 6);
  });

  it('a look overrides the display for one character: its skin, its bones, and what its heat map shows', () => {
    const dressed = (id: string) =>
      character({ id, skeleton: { name: 'one', joints: [joint(-1)] }, skins: [skin(id, 0)] });
    const all = new ShownCharacters(
      new Group(),
      () => new CharacterView(new DrawnSkins()),
      () => {},
    );
    const both = documentOf(dressed('near'), dressed('far'));
    const heat = Float32Array.of(0.25);
    const look = { characterId: 'far', skin: 'heat', bones: true, heat } as const;
    const meshOf = (id: string) => all.get(id)?.view.skinnedMeshes[0];
    const materialsOf = (id: string) => [meshOf(id)?.material ?? []].flat().map(({ name }) => name);
    all.show(both, DEFAULT_DISPLAY, {}, 0, true, look);
    expect(['near', 'far'].flatMap(materialsOf)).toEqual(['skin solid', 'skin heat']);
    const values = () => heatValuesOf(meshOf('far'))?.image.data?.[0];
    expect(values()).toBe(0.25);
    expect(all.posedSkeletons(new Map(), look).map(({ withBones }) => withBones)).toEqual([false, true]);

    all.show(both, { ...DEFAULT_DISPLAY, skin: 'heat' }, {}, 0, true);
    expect(['near', 'far'].flatMap(materialsOf)).toEqual(['skin heat', 'skin heat']);
    expect(values()).toBeUndefined();
    expect(all.posedSkeletons(new Map()).some(({ withBones }) => withBones)).toBe(false);
  });
});

/** Where a point of the scene is in the picture, −1 to 1 from edge to edge, and how far its grid reaches. */
function framedBy(all: ShownCharacters, range: readonly [number, number], aspect: number) {
  const boxes = all.boundsOfMotion(range, range[0]).flatMap((b) => [...b.min.toArray(), ...b.max.toArray()]);
  const axes = new Float64Array(12);
  lookingFrom(0.6, 1.32, axes);
  const tan = Math.tan((16 * Math.PI) / 180);
  const { x, y, z, middle } = fitEye(boxes, axes, tan, aspect, 1.08);
  const camera = new PerspectiveCamera(32, aspect, 0.01, 1e4);
  camera.position.set(
    axes[0] * x + axes[4] * y + axes[8] * z,
    axes[1] * x + axes[5] * y + axes[9] * z,
    axes[2] * x + axes[6] * y + axes[10] * z,
  );
  camera.quaternion.setFromEuler(new Euler(1.32 - Math.PI / 2, 0.6, 0, 'YXZ'));
  camera.updateMatrixWorld();
  return { camera, gridReach: Grid.reach(z - middle) };
}

describe('views of characters', () => {
  const posts = (count: number) => Array.from({ length: count }, (_, i) => character({ id: `post${i}` }));
  /** With what is shown of the views that it makes. */
  function counted() {
    const said: string[] = [];
    const all = new ShownCharacters(
      new Group(),
      (id) => {
        const view = new CharacterView(new DrawnSkins());
        const { show, dispose } = view;
        view.show = (...given) => {
          said.push(`show ${id}`);
          show.apply(view, given);
        };
        view.dispose = () => {
          said.push(`dispose ${id}`);
          dispose.apply(view);
        };
        return view;
      },
      () => {},
    );
    return { all, taken: () => said.splice(0) };
  }

  it('another display shows only those anew that it draws or poses otherwise', () => {
    const { all, taken } = counted();
    const document = documentOf(...posts(3), character({ id: 'skinned', skins: [skin()] }));
    all.show(document, DEFAULT_DISPLAY, {}, 0, true);
    expect(taken()).toHaveLength(4);
    all.show(document, { ...DEFAULT_DISPLAY, names: true }, {}, 0, true);
    expect(taken()).toEqual(['show skinned']);
    all.show(document, { ...DEFAULT_DISPLAY, inPlace: true }, {}, 0, true);
    expect(taken()).toHaveLength(4);
    all.show(document, { ...DEFAULT_DISPLAY, inPlace: true }, {}, 0, true);
    expect(taken()).toEqual(['show skinned']);
  });

  it('those prepared beforehand are taken for the characters that come, and let go of if they do not', () => {
    const { all, taken } = counted();
    const [a, b, c] = posts(3);
    for (const one of [a, b, a]) all.prepareView(one, DEFAULT_DISPLAY, 0);
    expect(taken()).toEqual(['show post0', 'show post1']);
    expect(all.get('post0')).toBeUndefined();
    all.show(documentOf(a, c), DEFAULT_DISPLAY, {}, 0, false);
    expect(taken()).toEqual(['show post2', 'dispose post1']);
    expect(all.visible.map(({ character: { id } }) => id)).toEqual(['post0', 'post2']);
    all.prepareView(a, DEFAULT_DISPLAY, 0);
    expect(taken()).toEqual([]);
    all.prepareView(b, DEFAULT_DISPLAY, 0);
    all.dispose();
    expect(taken().sort()).toEqual(['dispose post0', 'dispose post1', 'dispose post2', 'show post1']);
  });

  it('a prepared one is shown anew if its character, its joint or the display is another by then', () => {
    const [a] = posts(1);
    const changes = [
      [{ ...a }, DEFAULT_DISPLAY, {}],
      [a, { ...DEFAULT_DISPLAY }, {}],
      [a, DEFAULT_DISPLAY, { characterId: 'post0', joint: 1 }],
    ] as const;
    for (const [now, display, selection] of changes) {
      const { all, taken } = counted();
      all.prepareView(a, DEFAULT_DISPLAY, 0);
      all.show(documentOf(now), display, selection, 0, false);
      expect(taken()).toEqual(['show post0', 'show post0']);
    }
  });

  it('framing asks no prepared one for the times that were found, unless what it asks has changed', () => {
    const walk = (id: string, z: number) =>
      captured(
        skeleton,
        takeOfRoots(
          skeleton,
          [0, 50, 300, 100].map((x) => [x, 85, z] as const),
        ),
        { id, space },
      );
    const walks = [walk('a', 0), walk('b', 200)];
    const range = walks[0].takes[0].range;
    let seeks = 0;
    const prepared = (wide = DEFAULT_DISPLAY) => {
      const all = new ShownCharacters(
        new Group(),
        () => {
          const view = new CharacterView(new DrawnSkins());
          const { seek } = view;
          view.seek = (time) => {
            seeks++;
            seek.call(view, time);
          };
          return view;
        },
        () => {},
      );
      for (const one of walks) all.prepareView(one, DEFAULT_DISPLAY, 0, framedTimes(range, walks));
      all.show(documentOf(...walks), wide, {}, 0, false);
      seeks = 0;
      return all;
    };
    const expected = (asked = range, display = DEFAULT_DISPLAY) => {
      const all = shown();
      all.show(documentOf(...walks), display, {}, 0, true);
      return all.boundsOfMotion(asked, 0);
    };
    const all = prepared();
    expect(all.boundsOfMotion(range, 0)).toEqual(expected());
    expect(seeks).toBe(0);
    expect(all.visible.map(({ view }) => view.dofs[0])).toEqual([0, 0]);
    // Found once: the next framing may come after an edit.
    expect(all.boundsOfMotion(range, 0)).toEqual(expected());
    expect(seeks).toBeGreaterThan(100);
    const half = [range[0], range[1] / 2] as const;
    expect(prepared().boundsOfMotion(half, 0)).toEqual(expected(half));
    const inPlace = { ...DEFAULT_DISPLAY, inPlace: true };
    expect(prepared(inPlace).boundsOfMotion(range, 0)).toEqual(expected(range, inPlace));
  });

  it('a prepared one is posed at the time that is shown', () => {
    const { all } = counted();
    const moving = captured(
      skeleton,
      takeOfRoots(skeleton, [
        [0, 85, 0],
        [0, 185, 0],
      ]),
      { id: 'moving', space },
    );
    all.prepareView(moving, DEFAULT_DISPLAY, 0);
    all.show(documentOf(moving), DEFAULT_DISPLAY, {}, moving.takes[0].range[1], false);
    expect(all.get('moving')?.view.dofs[1]).toBeCloseTo(185, 9);
  });
});

describeShared('captures of the reference, framed', () => {
  const files = ['bandai-namco-bow-normal', 'cmu-01_01', 'cmu-daz-pirouette', 'rokoko-dance', 'poser-sl-walk'];
  it.each(files)('every joint of %s is in the picture at every frame, wide or tall', (name) => {
    const [{ skeleton: own, take }] = sharedCaptures(`${name}.bvh`);
    if (!take?.samples) throw new Error('the file has no motion');
    const all = shown(captured(own, take, { id: name, space }));
    const { view, placements } = all.visible[0];
    const matrix = new Matrix4().fromArray(placements);
    for (const aspect of [1.6, 0.5]) {
      const { camera, gridReach } = framedBy(all, take.range, aspect);
      const point = new Vector3();
      for (let f = 0; f < take.samples.frameCount; f++) {
        view.seek(take.range[0] + f * take.samples.frameSeconds);
        for (let j = 0; j < own.joints.length; j++) {
          point.fromArray(view.worldMatrices, 16 * j + 12).applyMatrix4(matrix);
          const isOnGrid = Math.hypot(point.x, point.z) < gridReach;
          point.project(camera);
          if (!isOnGrid || Math.abs(point.x) > 1 || Math.abs(point.y) > 1)
            throw new Error(`${own.joints[j].name} leaves at frame ${f}`);
        }
      }
    }
  });
});
