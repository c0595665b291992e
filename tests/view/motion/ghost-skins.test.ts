import { type Mesh, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Character } from '../../../src/model/document.ts';
import { DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import { DEFAULT_DISPLAY, type Display } from '../../../src/model/session.ts';
import { CharacterView } from '../../../src/view/character-view.ts';
import { GhostSkins } from '../../../src/view/motion/ghost-skins.ts';
import { DrawnSkins } from '../../../src/view/skin/drawn-skins.ts';
import { STAGE_THEMES } from '../../../src/view/theme.ts';
import { channelOf } from '../../edit/keys/channels.ts';
import { character, skeleton, skin, takeOfValues } from '../../helpers/builders.ts';

const SHOWN: Display = {
  ...DEFAULT_DISPLAY,
  skin: 'solid',
  ghosts: true,
  ghostsOf: 'skin',
  ghostsBefore: 2,
  ghostsAfter: 2,
  ghostStep: 1,
};
/** It goes along x, a unit a second. */
const GOING = channelOf([
  [0, 0, 'linear'],
  [10, 10, 'linear'],
]);
const walker: Character = character({
  skeleton: skeleton(2),
  skins: [skin('hero')],
  takes: [{ ...takeOfValues('walk', []), range: [0, 10], channels: [GOING] }],
  shownTake: 0,
});

function shown(of: Character = walker) {
  const skins = new DrawnSkins();
  const view = new CharacterView(skins);
  view.show(of, SHOWN, undefined);
  const ghosts = new GhostSkins(skins);
  ghosts.setTheme(STAGE_THEMES.dark);
  const fill = (timeSeconds: number, display = SHOWN) =>
    ghosts.fill(of, view.sharedSkin, display, timeSeconds, [0, 10], 30);
  const camera = new PerspectiveCamera(53, 1, 0.1, 100);
  camera.position.z = 10;
  camera.updateMatrixWorld();
  const calls = () => {
    skins.aim(camera);
    // The character's own is the only opaque one.
    const drawn = (skins.object.children as Mesh[]).filter(({ visible }) => visible);
    return drawn.filter(({ material }) => !Array.isArray(material) && material.transparent);
  };
  return { skins, view, ghosts, fill, calls };
}

const instances = (calls: readonly Mesh[]) =>
  calls.map(({ geometry }) => ('instanceCount' in geometry ? Number(geometry.instanceCount) : 0));

describe('ghosts of a skin', () => {
  it('are drawn with the vertices of the shown skin, one call for each, and none without times', () => {
    const { view, fill, calls } = shown();
    fill(5);
    expect(instances(calls())).toEqual([1, 1, 1, 1]);
    const own = view.sharedSkin?.geometry.attributes.position;
    for (const { geometry } of calls()) expect(geometry.attributes.position).toBe(own);
    fill(0);
    expect(instances(calls())).toEqual([1, 1]);
    fill(5, { ...SHOWN, ghostsBefore: 0, ghostsAfter: 0 });
    expect(calls()).toEqual([]);
  });

  it('are in the poses of their times, at each instance of the character', () => {
    const placements = [0, 3].map((z) => ({ ...DEFAULT_PLACEMENT, position: [0, 0, z] as const }));
    const { skins, fill, calls } = shown({ ...walker, placements });
    const meshes: Vector3[] = [];
    const draw = skins.draw.bind(skins);
    const added = new Set<Parameters<typeof draw>[0]>();
    skins.draw = (mesh, drawing) => {
      added.add(mesh);
      draw(mesh, drawing);
    };
    fill(5);
    expect(instances(calls())).toEqual([2, 2, 2, 2]);
    for (const mesh of added) meshes.push(mesh.getVertexPosition(0, new Vector3()).applyMatrix4(mesh.matrixWorld));
    expect(meshes.map(({ x, z }) => [x, z])).toEqual(
      [3, 4, 6, 7].flatMap((x) => [0, 3].map((z) => [expect.closeTo(x, 6), expect.closeTo(z, 6)])),
    );
  });

  it('keep what they have made while time goes on, and give all of it back', () => {
    const { skins, ghosts, fill } = shown();
    fill(5);
    let made = 0;
    const allocate = skins.palette.allocate.bind(skins.palette);
    skins.palette.allocate = (texels) => {
      made++;
      return allocate(texels);
    };
    for (let t = 2; t < 8; t += 0.1) fill(t);
    expect(made).toBe(0);
    const before = skins.object.children.length;
    ghosts.dispose();
    expect(skins.object.children.length).toBe(before - 4);
  });

  it('of many vertices are left out while it plays', () => {
    const many = 100_000;
    const large = { ...skin('large'), positions: new Float64Array(3 * many), normals: new Float64Array(3 * many) };
    const attachments = {
      start: Uint32Array.from({ length: many + 1 }, (_, v) => v),
      joints: new Uint32Array(many),
      weights: new Float64Array(many).fill(1),
    };
    const { view, ghosts, fill, calls } = shown({
      ...walker,
      skins: [{ ...large, attachments }],
      placements: [DEFAULT_PLACEMENT, DEFAULT_PLACEMENT],
    });
    // It is prepared in slices.
    return view.prepare().then(() => {
      fill(5);
      expect(instances(calls())).toEqual([2, 2, 2, 2]);
      ghosts.isPlaying = true;
      fill(5);
      expect(calls()).toEqual([]);
      ghosts.isPlaying = false;
      fill(5);
      expect(calls()).toHaveLength(4);
    });
  });
});
