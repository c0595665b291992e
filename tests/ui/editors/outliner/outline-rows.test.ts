import { describe, expect, it } from 'vitest';
import type { Document } from '../../../../src/model/document.ts';
import { oneSurface, type Skin } from '../../../../src/model/skin.ts';
import {
  keysAbove,
  type OutlineRow,
  outlineRows,
  sameOutline,
} from '../../../../src/ui/editors/outliner/outline-rows.ts';
import { channel, character, documentOf, joint, skeleton, take } from '../../builders.ts';

const asIs = (_key: string, otherwise: boolean) => otherwise;
const text = (rows: readonly OutlineRow[]) => rows.map((r) => `${'  '.repeat(r.depth)}${r.label}`);
const legs = skeleton(['hips', -1], ['leg_l', 0], ['foot_l', 1], ['leg_r', 0]);

function skin(name: string): Skin {
  const triangles = new Uint32Array(3);
  const surfaces = oneSurface(triangles);
  return { name, positions: new Float64Array(9), triangles, surfaces, bindings: new Float64Array(0) };
}

const wasp = character({
  skeleton: legs,
  skins: [skin('smooth'), skin('rough')],
  shownSkin: 1,
  takes: [take([0, 2], channel(0))],
});

describe('outlineRows', () => {
  it('collapses many characters, unless expanded by hand', () => {
    const many = documentOf(...Array.from({ length: 50 }, (_, i) => character({ ...wasp, id: `c${i}` })));
    expect(outlineRows(many, asIs)).toHaveLength(50);
    const one = (key: string, otherwise: boolean) => key === 'c7' || otherwise;
    expect(outlineRows(many, one).length).toBeGreaterThan(55);
    expect(outlineRows(many, asIs, 'foot_l')).toHaveLength(50 * 5);
  });

  it('lists a character and its parts', () => {
    expect(text(outlineRows(documentOf(wasp), asIs))).toEqual([
      'wasp',
      '  Joints',
      '    hips',
      '      leg_l',
      '        foot_l',
      '      leg_r',
      '  Skins',
      '    smooth',
      '    rough',
      '  Takes',
      '    walk',
    ]);
  });

  it('leaves a namespace that all joints share out of labels; names and search have it', () => {
    const named = { ...wasp, skeleton: skeleton(['mixamorig:Hips', -1], ['mixamorig:LeftLeg', 0]) };
    const [joint] = outlineRows(documentOf(named), asIs, 'mixamorig:left').filter(({ index }) => index === 1);
    expect(joint).toMatchObject({ label: 'LeftLeg', name: 'mixamorig:LeftLeg' });
  });

  it('marks the shown alternative', () => {
    const rows = outlineRows(documentOf(wasp), asIs).filter((r) => r.kind === 'skin');
    expect(rows.map((r) => r.shown)).toEqual([false, true]);
  });

  it('marks a skin that no joint moves', () => {
    const attachments = { start: new Uint32Array(4), joints: new Uint32Array(0), weights: new Float64Array(0) };
    const details = (skeletal: Partial<Parameters<typeof character>[0]>) =>
      outlineRows(
        documentOf(character({ skins: [skin('bare'), { ...skin('bound'), attachments }], ...skeletal })),
        asIs,
      )
        .filter((r) => r.kind === 'skin')
        .map((r) => r.detail);
    expect(details({ skeleton: legs })).toEqual(['no weights', '3 vertices']);
    expect(details({})).toEqual(['3 vertices', '3 vertices']);
  });

  it('outlineRows leaves out what is collapsed', () => {
    const folded = (key: string, otherwise: boolean) => (key === 'c1/joint/1' ? false : otherwise);
    expect(text(outlineRows(documentOf(wasp), folded)).slice(2, 5)).toEqual(['    hips', '      leg_l', '      leg_r']);
    const closed = (key: string, otherwise: boolean) => (key === 'c1' ? false : otherwise);
    expect(text(outlineRows(documentOf(wasp), closed))).toEqual(['wasp']);
  });

  it('finds joints by name and shows their ancestors, even if collapsed', () => {
    const rows = outlineRows(documentOf(wasp), () => false, 'FOOT');
    expect(text(rows)).toEqual(['wasp', '  Joints', '    hips', '      leg_l', '        foot_l']);
    expect(rows.filter((r) => !r.onTheWay).map((r) => r.label)).toEqual(['foot_l']);
  });

  it('finds a joint by its index', () => {
    expect(outlineRows(documentOf(wasp), asIs, '#3').at(-1)).toMatchObject({ kind: 'joint', index: 3 });
  });

  it('finds nothing if no name matches', () => {
    expect(outlineRows(documentOf(wasp), asIs, 'wheel')).toEqual([]);
  });

  it('distinguishes joints of the same name, and shows nameless ones', () => {
    const twins = character({ skeleton: skeleton(['a', -1], ['a', 0], ['', 0]) });
    const rows = outlineRows(documentOf(twins), asIs).filter((r) => r.kind === 'joint');
    expect(new Set(rows.map((r) => r.key)).size).toBe(3);
    expect(rows[2].label).toBe('');
  });

  it('handles a chain as deep as a file can have', () => {
    const joints = Array.from({ length: 20_000 }, (_, i) => joint(`j${i}`, i - 1));
    const chain = documentOf(character({ skeleton: { name: 'chain', joints } }));
    expect(outlineRows(chain, () => true)).toHaveLength(20_002);
    expect(outlineRows(chain, asIs).length).toBeLessThan(10);
    expect(keysAbove(chain.characters[0], 19_999)).toHaveLength(2 + 19_999);
  });
});

it('has the same rows if only the pose changed', () => {
  const posed: Document = documentOf({ ...wasp, pose: wasp.pose.map(() => 1) });
  expect(sameOutline(documentOf(wasp), posed)).toBe(true);
  expect(sameOutline(documentOf(wasp), documentOf({ ...wasp, name: 'bee' }))).toBe(false);
  expect(sameOutline(documentOf(wasp), documentOf({ ...wasp, shownSkin: 0 }))).toBe(false);
  expect(sameOutline(documentOf(wasp), documentOf())).toBe(false);
});

it('expands the ancestors of a joint', () => {
  expect(keysAbove(wasp, 2)).toEqual(['c1', 'c1/joint', 'c1/joint/1', 'c1/joint/0']);
});
