import { describe, expect, it } from 'vitest';
import { character, skeleton, skin } from '../../helpers/builders.ts';
import { complaintsOf, glbOf } from '../../helpers/glb.ts';

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A triangle whose first vertex follows six joints in a chain, of which the last is turned. */
function six(weights: readonly number[]) {
  const own = skeleton(6);
  const turned = { ...own, joints: own.joints.map((joint, j) => (j === 1 ? { ...joint, pose: [0, 0, 1] } : joint)) };
  const hero = skin('hero', 5, {
    attachments: {
      start: Uint32Array.of(0, 6, 7, 7),
      joints: Uint32Array.of(0, 1, 2, 3, 4, 5, 0),
      weights: Float64Array.of(...weights, 1),
    },
    bindings: Float64Array.from(Array.from({ length: 6 }, () => IDENTITY).flat()),
  });
  return character({ skeleton: turned, skins: [hero], pose: [0, 0, 0, ...turned.joints.flatMap(({ pose }) => pose)] });
}

const codesOf = (glb: ReturnType<typeof glbOf>) => glb.report.losses.map(({ code }) => code);

describe('what GLB loses', () => {
  it('all attachments are written, the strongest first, and what programs with four are off is told', async () => {
    const made = glbOf(six([0.1, 0.2, 0.3, 0.15, 0.05, 0.2]));
    expect(await complaintsOf(made.bytes)).toEqual([]);
    const { attributes } = made.json.meshes?.[0].primitives[0] ?? { attributes: {} };
    expect(Object.keys(attributes)).toEqual(['POSITION', 'NORMAL', 'JOINTS_0', 'WEIGHTS_0', 'JOINTS_1', 'WEIGHTS_1']);
    expect(codesOf(made)).toEqual(['influences-many']);
    expect(made.report.losses[0].displacement).toBeGreaterThan(0.1);
  });

  it('with four attachments the rest is cut, and how far that moves a vertex is the same', async () => {
    const all = six([0.1, 0.2, 0.3, 0.15, 0.05, 0.2]);
    const made = glbOf(all, { influences: 4 });
    expect(await complaintsOf(made.bytes)).toEqual([]);
    expect(made.json.meshes?.[0].primitives[0].attributes).not.toHaveProperty('JOINTS_1');
    expect(codesOf(made)).toEqual(['influences-cut']);
    expect(made.report.losses[0].displacement).toBe(glbOf(all).report.losses[0].displacement);
  });

  it('weights that do not sum to 1 are normalised, and how far that moves a vertex is told', async () => {
    const made = glbOf(six([0.5, 0.2, 0, 0, 0, 0]));
    expect(await complaintsOf(made.bytes)).toEqual([]);
    expect(codesOf(made)).toEqual(['weights-normalised']);
    expect(made.report.losses[0].message).toContain('1 of 3 vertices');
  });

  it('a vertex without attachments hangs on a joint that never moves', () => {
    const { json } = glbOf(six([1, 0, 0, 0, 0, 0]));
    const joints = json.skins?.[0].joints ?? [];
    expect(joints).toHaveLength(7);
    expect(json.nodes[joints[6]]).toEqual({ name: 'resting' });
    expect(json.nodes[0].children).toContain(joints[6]);
  });

  it('bindings that scale are told, for Blender; those of few digits are not', () => {
    const own = six([1, 0, 0, 0, 0, 0]);
    const bound = (x: number) => {
      const [hero] = own.skins;
      const bindings = hero.bindings.slice();
      bindings[16] = x;
      return glbOf({ ...own, skins: [{ ...hero, bindings }] });
    };
    expect(codesOf(bound(2))).toEqual(['bindings-in-blender']);
    expect(bound(2).report.losses[0].message).toContain('1 of 6 bindings');
    expect(codesOf(bound(1.001))).toEqual([]);
  });

  it('a texture that was not given is told', () => {
    const own = six([1, 0, 0, 0, 0, 0]);
    const [hero] = own.skins;
    const painted = {
      ...hero,
      texcoords: new Float64Array(6),
      surfaces: [{ ...hero.surfaces[0], material: { name: 'm', texture: 'a.png' } }],
    };
    expect(codesOf(glbOf({ ...own, skins: [painted] }))).toEqual(['texture-left-out']);
  });
});
