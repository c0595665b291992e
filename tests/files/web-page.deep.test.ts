/** Pages that characters are saved in. */
import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { retargetedTo } from '../../src/edit/commands/retarget.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import type { Character } from '../../src/model/document.ts';
import { DEFAULT_PLACEMENT } from '../../src/model/document.ts';
import { openCharacters } from '../../src/viewer/open.ts';
import { ODD_AMC, ODD_ASF } from '../helpers/acclaim.ts';
import { anyText } from '../helpers/any-text.ts';
import { character, skeleton, skin, takeOfValues } from '../helpers/builders.ts';
import { glbOf } from '../helpers/glb.ts';
import { hero } from '../helpers/hero.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { filesIn, openedFrom, pageOf, unescaped } from '../helpers/saved-page.ts';

const SAMPLES = new URL('../../public/samples/', import.meta.url);

async function opened(files: Readonly<Record<string, Uint8Array | string>>): Promise<readonly Character[]> {
  const given = Object.entries(files).map(([path, content]) => ({ path, blob: new Blob([content as BlobPart]) }));
  const { characters, diagnostics } = await openCharacters({ files: given });
  expect(diagnostics.filter(({ severity }) => severity === 'error')).toEqual([]);
  return characters;
}

const sample = (...names: string[]) =>
  Object.fromEntries(names.map((name) => [name, readFileSync(new URL(name, SAMPLES))]));

function worldsAt(shown: Character, seconds: number): readonly number[] {
  const dofs = new Float64Array(dofCountOf(shown));
  poseAt(shown, seconds, dofs);
  if (!shown.skeleton) return [...dofs];
  const compiled = compileSkeleton(shown.skeleton);
  const worlds = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, worlds);
  return [...worlds, ...dofs.subarray(dofs.length - shown.morphs.length)];
}

/** Half of the ninth digit behind the point. */
const NEAR = 5e-10;

/** Saves, opens, and compares: how it looks and moves. */
async function expectSame(characters: readonly Character[]): Promise<readonly Character[]> {
  const { characters: again, diagnostics } = openedFrom(pageOf(characters));
  expect(diagnostics.filter(({ severity }) => severity === 'error')).toEqual([]);
  expect(again.map(({ name }) => name)).toEqual(characters.map(({ name }) => name));
  again.forEach((one, i) => {
    const own = characters[i];
    const { placements, timeOffsetSeconds, space, isHidden, clampsToLimits } = one;
    expect({ placements, timeOffsetSeconds, space, isHidden, clampsToLimits }).toEqual({
      placements: own.placements,
      timeOffsetSeconds: own.timeOffsetSeconds,
      space: own.space,
      isHidden: own.isHidden,
      clampsToLimits: own.clampsToLimits,
    });
    expect(one.skins[one.shownSkin]?.positions).toEqual(own.skins[own.shownSkin]?.positions);
    expect(one.textures.map(({ bytes }) => bytes)).toEqual(own.textures.map(({ bytes }) => bytes));
    for (const seconds of [0, 0.37, 1.1]) {
      const [ours, theirs] = [worldsAt(own, seconds), worldsAt(one, seconds)];
      expect(theirs.length).toBe(ours.length);
      // An `expect` for each of thousands of numbers took most of the time.
      theirs.forEach((value, k) => {
        if (!(Math.abs(value - ours[k]) < NEAR)) expect(value, `${one.name} at ${seconds} s, ${k}`).toBe(ours[k]);
      });
    }
  });
  return again;
}

describe('a saved page', () => {
  it('a saved page says in its first lines what it is, and how it is shown', () => {
    const page = pageOf([character({ name: 'wasp' })], { theme: 'dark', attributes: { controls: '', time: '1.25' } });
    expect(page).toMatch(/^<!doctype html>\n<!--\n {2}Characters to look at, made by Marrow \d/);
    expect(page).toContain('<title>wasp</title>');
    expect(page).toContain('<marrow-viewer controls time="1.25" background="dark"></marrow-viewer>');
    expect(page).toContain('<pre hidden data-file="wasp/hero.skel">\n');
  });

  it('nothing in names and contents of files is markup of a saved page', () => {
    const odd = fc.oneof(
      anyText({ maxLength: 30 }),
      fc.constantFrom(
        '</script><script>alert(1)</script>',
        '<!--',
        '--><img src=x onerror=y>',
        '"\' onload="x',
        '&lt;',
        ']]>',
        '</pre>',
        '\r\n\0',
        '../..',
        '\ud800',
      ),
    );
    const tags = (page: string) => page.match(/<[^>]*>?/g)?.map((tag) => tag.replace(/="[^"]*"/g, '=""'));
    const plain = tags(
      pageOf([character({ textures: [{ name: 'a.png', mime: 'image/png', bytes: new Uint8Array(9) }] })]),
    );
    fc.assert(
      fc.property(odd, odd, odd, fc.uint8Array({ maxLength: 60 }), (name, joint, picture, data) => {
        const bytes = new Uint8Array(data);
        const textures = [{ name: `${picture}.png`, mime: 'image/png', bytes }];
        const bones = skeleton(2);
        const joints = bones.joints.map((one) => ({ ...one, name: joint }));
        const page = pageOf([character({ name, textures, skeleton: { ...bones, joints } })], {
          attributes: { controls: '' },
        });
        // A file may be plain text or packed.
        expect(tags(page)?.map((tag) => tag.replace('data-packed', 'data-file'))).toEqual(
          plain?.map((tag) => tag.replace('data-packed', 'data-file')),
        );
        const files = [...filesIn(page)];
        expect(files.map(([, content]) => content)).toContainEqual(bytes);
        for (const [path] of files) expect(path.split('/').length).toBe(2);
        expect(unescaped(/<title>([^<]*)/.exec(page)?.[1] ?? '')).toBe(name || 'Marrow');
      }),
    );
  });

  it('a saved page shows characters as they are: edited, placed, posed, hidden, with any take and skin', async () => {
    const [walker] = await opened(
      sample(
        'walker.rig',
        'walker.skel',
        'walker.skin',
        'walker_blink.morph',
        'walker_smile.morph',
        'walker_breathe.morph',
        'walker_walk.anim',
        'walker.png',
      ),
    );
    const placed = { position: [1, 0, -2], turn: [0, 1, 0], scale: 1.5 } as const;
    const still = {
      ...walker,
      id: 'still',
      shownTake: -1,
      placements: [placed, DEFAULT_PLACEMENT],
      isHidden: true as const,
    };
    const pose = still.pose.map((value, i) => value + 0.01 * (i % 5));
    const [first, second] = await expectSame([
      { ...walker, timeOffsetSeconds: 0.25 },
      { ...still, pose },
    ]);
    expect(first.takes[first.shownTake].name).toBe('walker_walk');
    expect(second.shownTake).toBe(-1);
    expect(first.id).not.toBe(second.id);

    const edited = {
      ...walker,
      takes: [
        takeOfValues(
          'made here',
          Array.from(walker.pose, (_, i) => 0.01 * i),
        ),
        ...walker.takes,
      ],
      shownTake: 0,
    };
    await expectSame([edited]);
    await expectSame([character({ skins: [skin('plain'), skin('other', 1)], shownSkin: 1 })]);
  });

  it('captures, characters of other programs and points are in a saved page as plain files', async () => {
    const captures = Object.fromEntries(OWN_CAPTURES);
    const bvh = await opened(captures);
    await expectSame(bvh);
    expect([...filesIn(pageOf(bvh)).keys()].every((name) => name.endsWith('.bvh'))).toBe(true);
    const walker = await hero();
    // Fitting keys to all of the walk takes longer, and shows nothing else.
    const takes = walker.takes.map((take) => ({ ...take, range: [0, 0.1] as const }));
    const glb = await opened({ 'hero.glb': glbOf({ ...walker, takes }).bytes });
    await expectSame(glb);
    await expectSame(await opened({ 'points.trc': TRC }));
    await expectSame(await opened({ 'a.asf': ODD_ASF, 'a.amc': ODD_AMC }));
  });

  it('a retargeted take is in a saved page as one of its character', async () => {
    const [source] = await opened(sample('walker.skel', 'walker_walk.anim'));
    const target = { ...source, id: 'target', name: 'target', takes: [], shownTake: -1 };
    const driven = retargetedTo(target, source, undefined, { plantsFeet: false });
    const [again] = openedFrom(pageOf([driven])).characters;
    expect(again.takes.length).toBe(1);
    const [ours, theirs] = [worldsAt(driven, 0.5), worldsAt(again, 0.5)];
    theirs.forEach((value, k) => void expect(value).toBeCloseTo(ours[k], 2));
  });
});

const TRC = [
  'PathFileType\t4\t(X/Y/Z)\tpoints.trc',
  'DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits',
  '60\t60\t2\t2\tmm',
  'Frame#\tTime\tLASI\t\t\tLeft knee\t\t',
  '\t\tX1\tY1\tZ1\tX2\tY2\tZ2',
  '',
  '1\t0\t1\t1000\t3\t4\t500\t6',
  '2\t0.0166667\t1.5\t1001\t3\t4\t501\t6',
].join('\n');
