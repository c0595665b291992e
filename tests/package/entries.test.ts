/** The entries of the npm package: they give what page and command give, and refuse what is no file in a sentence. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { takeArrays, writeCsv, writeJson, writeNpz, writeParquet } from '../../src/package/dataset.ts';
import {
  bakeRetarget,
  deformSkin,
  dofCount,
  evaluateChannel,
  ikProblem,
  localMatrices,
  movePin,
  poseAt,
  retarget,
  skinMatrices,
  solveIk,
  worldMatrices,
} from '../../src/package/evaluate.ts';
import { convertCharacter, writeFbx, writeGlb } from '../../src/package/export.ts';
import * as formats from '../../src/package/formats.ts';
import { readCharacters, readFbx, readGltf } from '../../src/package/import.ts';
import { createCharacter, shownTake, UserError, vertexCount } from '../../src/package/model.ts';
import { readNpz } from '../dataset/read-npz.ts';
import { ODD_AMC, ODD_ASF } from '../helpers/acclaim.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { posed } from '../helpers/posed.ts';

const SAMPLES = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const sample = (name: string) => readFileSync(SAMPLES + name);
const named = (name: string) => ({ name, content: sample(name) });
const capture = (name = 'own-walk.bvh') => ({ name, content: OWN_CAPTURES.get(name) ?? '' });

async function walker() {
  const { characters } = await readCharacters(
    ['walker.skel', 'walker.skin', 'walker_smile.morph', 'walker_walk.anim'].map(named),
  );
  return characters[0];
}

describe('marrow/formats', () => {
  it('marrow/formats reads what it writes, of every format, as it was', () => {
    const { skeletons } = formats.readSkel(sample('walker.skel'), 'a.skel');
    expect(formats.readSkel(formats.writeSkel(skeletons).text, 'a.skel').skeletons).toEqual(skeletons);
    const { skin } = formats.readSkin(sample('walker.skin'), 'a.skin');
    expect(skin && formats.readSkin(formats.writeSkin(skin).text, 'a.skin').skin).toEqual(skin);
    const { morph } = formats.readMorph(sample('walker_smile.morph'), 'a.morph');
    expect(morph && formats.readMorph(formats.writeMorph(morph).text, 'a.morph').morph).toEqual(morph);
    const { take } = formats.readAnim(sample('tangents.anim'), 'a.anim');
    expect(take && formats.readAnim(formats.writeAnim(take).text, 'a.anim').take).toEqual(take);
    const { rig } = formats.readRig(sample('walker.rig'), 'a.rig');
    expect(rig && formats.readRig(formats.writeRig(rig).text, 'a.rig').rig).toEqual(rig);
    const { captures, space } = formats.readBvh(capture().content, 'a.bvh');
    expect(formats.readBvh(formats.writeBvh(captures).text, 'a.bvh').captures).toEqual(captures);
    expect(space).toMatchObject({ up: 'y', unit: 'centimetres', known: 'guessed' });
    const asf = formats.readAsf(ODD_ASF, 'a.asf').skeleton;
    if (!asf) throw new Error('The skeleton has an error.');
    expect(formats.readAsf(formats.writeAsf(asf).text, 'a.asf').skeleton?.joints.length).toBe(asf.joints.length);
    const amc = formats.readAmc(ODD_AMC, asf, 'a.amc').take;
    expect(amc?.samples?.frameCount).toBe(2);
    const written = amc && formats.writeAmc({ skeleton: asf, take: amc }).text;
    expect(written && formats.readAmc(written, asf, 'a.amc').take).toEqual(amc);
    const { poses } = formats.readPoses('pose wave {\n\tjoint head { rx 0.5 }\n}\n', 'a.pose');
    expect(poses && formats.readPoses(formats.writePoses(poses).text, 'a.pose').poses).toEqual(poses);
    const markers = [{ label: 'step', timeSeconds: 0.5 }];
    expect(formats.readMarkers(formats.writeMarkers(markers).text).markers).toEqual(markers);
  });

  it('readSkelRows reads a joint on each line, and readSkel the axis-angle form', () => {
    const rows = formats.readSkelRows('0 1 0 -1\n1 0 0 0\n', 'a.skel').skeleton;
    expect(rows?.joints.map(({ parent, offset }) => [parent, ...offset])).toEqual([
      [-1, 0, 1, 0],
      [0, 1, 0, 0],
    ]);
    expect(formats.readSkel('0 1 0 0 1 0', 'a.skel').skeleton?.form).toBe('axis-angle');
  });

  it('locateProblems gives the places of problems that the page gives', async () => {
    const text = sample('walker.skel').toString().replace('offset 0 ', 'offset ');
    const told = formats.readSkel(text, 'walker.skel').diagnostics;
    const located = formats.locateProblems(text, 'walker.skel', told);
    const { diagnostics } = await readCharacters([{ name: 'walker.skel', content: text }]);
    expect(located.length).toBeGreaterThan(0);
    expect(diagnostics).toEqual(located);
    expect(formats.locateProblems(text, 'notes.docx', told)).toEqual(told);
  });

  it('marrow/formats takes text, bytes, parts of buffers and whole ones alike', () => {
    const bytes = sample('cube.skel');
    const padded = new Uint8Array(bytes.length + 9);
    padded.set(bytes, 5);
    const whole = padded.slice(5, 5 + bytes.length).buffer;
    const all = [bytes.toString(), bytes, padded.subarray(5, 5 + bytes.length), whole];
    const [first, ...others] = all.map((content) => formats.readSkel(content).skeleton);
    expect(first?.joints.length).toBe(1);
    for (const other of others) expect(other).toEqual(first);
  });

  it('marrow/formats tells of a broken file at its place, and of what is no file in a sentence', () => {
    const { skeleton, skeletons, diagnostics } = formats.readSkel('balljoint a {\n  offset 1 two 3\n}\n', 'a.skel');
    expect([skeleton, skeletons]).toEqual([undefined, []]);
    expect(diagnostics[0]).toMatchObject({ severity: 'error', file: 'a.skel', line: 2, column: 12 });
    const readers = Object.entries(formats).filter(([name]) => name.startsWith('read'));
    expect(readers.length).toBe(11);
    const wrong: readonly (readonly [unknown, string])[] = [
      [undefined, 'undefined'],
      [null, 'null'],
      [{ text: '' }, 'object'],
      [Promise.resolve(''), 'a promise; await it'],
    ];
    for (const [name, read] of readers) {
      for (const [content, found] of wrong) {
        // As a program without types calls it.
        const call = () => (read as (content: unknown, other?: unknown) => unknown)(content, undefined);
        expect(call, name).toThrow(new UserError(`Expected the text or the bytes of a file, found ${found}.`));
      }
    }
  });
});

describe('marrow/evaluate', () => {
  it('marrow/evaluate poses and skins as the command does, into arrays that are given', async () => {
    const character = await walker();
    const { skeleton, skins } = character;
    if (!skeleton) throw new Error('The walker has a skeleton.');
    const dofs = new Float64Array(dofCount(character));
    expect(poseAt(character, 0.4, dofs)).toBe(dofs);
    const expected = posed({ skeleton, skins, morphs: character.morphs, takes: character.takes, textures: [] }, 0, 0.4);
    const world = worldMatrices(skeleton, dofs);
    expect(world).toEqual(expected.worlds);
    const positions = new Float64Array(3 * vertexCount(skins[0]));
    deformSkin(character, dofs, positions, positions.slice());
    expect(positions).toEqual(expected.positions);
    expect(localMatrices(skeleton, dofs).subarray(0, 16)).toEqual(world.subarray(0, 16));
    expect(skinMatrices(skins[0], world).length).toBe(skins[0].bindings.length);
    const take = shownTake(character);
    expect(take && evaluateChannel(take, 10, 0.4)).toBe(dofs[10]);
  });

  it('marrow/evaluate moves a hand to its target, and retargets a take', async () => {
    const character = await walker();
    const { skeleton } = character;
    if (!skeleton) throw new Error('The walker has a skeleton.');
    const dofs = poseAt(character, 0);
    const hand = skeleton.joints.findIndex(({ name }) => name === 'hand_l');
    const problem = ikProblem(skeleton, [{ joint: hand, point: [0, 0, 0], target: [0, 0, 0] }], dofs);
    movePin(problem, 0, 0.3, 1, 0.3);
    expect(solveIk(problem, dofs, true).isSolved).toBe(true);
    const at = worldMatrices(skeleton, dofs).subarray(16 * hand + 12, 16 * hand + 15);
    expect(Math.hypot(at[0] - 0.3, at[1] - 1, at[2] - 0.3)).toBeLessThan(1e-4);

    const moved = retarget(createCharacter({ name: 'twin', skeleton }), character);
    const baked = bakeRetarget(moved, 30);
    expect(baked.driver).toBeUndefined();
    expect(Array.from(poseAt(baked, 0.5))).not.toEqual(Array.from(poseAt(baked, 0)));
    const lone = createCharacter({ name: 'lone' });
    expect(() => retarget(lone, character)).toThrow(UserError);
    expect(() => bakeRetarget(character)).toThrow('walker is not retargeted.');
  });
});

describe('marrow/import and marrow/export', () => {
  it('marrow/import reads what marrow/export writes', async () => {
    const { characters } = await readCharacters([named('cube.skel'), named('cube_spin.anim')]);
    const { bytes, report } = writeGlb(characters[0]);
    const { character } = await readGltf(bytes);
    expect(character?.skeleton?.joints.length).toBeGreaterThanOrEqual(report.joints);
    expect(character?.takes.map(({ name }) => name)).toEqual(['cube_spin']);
    const [bvh] = convertCharacter(characters[0], 'bvh', { framesPerSecond: 25 });
    expect(bvh.name).toBe('cube_spin.bvh');
    const { take } = formats.readBvh(bvh.text, bvh.name);
    expect(take?.samples?.frameSeconds).toBeCloseTo(0.04, 12);
    for (const write of [writeGlb, writeFbx]) {
      const wrong = () => write(characters[0], { take: 'dance' });
      expect(wrong).toThrow('cube has no take dance; its takes are cube_spin.');
    }
  });

  it('writeFbx writes joints, skin, morphs and takes, which readFbx reads', async () => {
    const whole = await walker();
    const { bytes, report, diagnostics } = writeFbx(whole);
    expect(report).toMatchObject({ bytes: bytes.length, joints: whole.skeleton?.joints.length, morphs: 1 });
    expect(diagnostics.every(({ file }) => file === 'walker.fbx')).toBe(true);
    const { character } = await readFbx(bytes, 'walker.fbx');
    expect(character?.skeleton?.joints.map(({ name }) => name)).toEqual(
      expect.arrayContaining(whole.skeleton?.joints.map(({ name }) => name) ?? []),
    );
    expect(character?.takes.map(({ name }) => name)).toEqual(['walker_walk']);
    expect(character && vertexCount(character.skins[0])).toBe(whole.skins[0] && vertexCount(whole.skins[0]));
  });

  it('marrow/import tells of files that hold something else, and throws for what is no file', async () => {
    for (const read of [readFbx, readGltf]) {
      const { character, diagnostics } = await read('not at all');
      expect(character).toBeUndefined();
      expect(diagnostics[0].severity).toBe('error');
    }
    const { characters, diagnostics } = await readCharacters([{ name: 'notes.docx', content: 'x' }]);
    expect([characters, diagnostics.length]).toEqual([[], 1]);
    await expect(readCharacters([{ name: 'a.skel', content: JSON.parse('7') }])).rejects.toThrow('found number.');
  });
});

describe('marrow/dataset', () => {
  it('marrow/dataset writes the arrays of a take in four formats', async () => {
    const { characters } = await readCharacters([capture()]);
    const arrays = takeArrays(characters[0], { fps: 15, precision: 'float64' });
    expect([arrays.frameCount, arrays.fps]).toEqual([30, 15]);
    const npz = readNpz(Buffer.from(writeNpz(arrays, { by: 'me' })));
    expect(npz.positions.shape).toEqual([30, arrays.names.length, 3]);
    expect(npz.positions.values).toEqual(Array.from(arrays.positions));
    expect(npz.meta.values).toEqual(['{"by":"me"}']);
    const parquet = Buffer.from(writeParquet(arrays));
    expect([parquet.toString('latin1', 0, 4), parquet.toString('latin1', parquet.length - 4)]).toEqual([
      'PAR1',
      'PAR1',
    ]);
    expect(writeCsv(arrays).trim().split('\n').length).toBe(31);
    expect(JSON.parse(writeJson(arrays, { by: 'me' }))).toMatchObject({ fps: 15, meta: { by: 'me' } });
    expect(() => takeArrays(createCharacter({ name: 'lone' }))).toThrow('lone has no skeleton.');
  });
});
