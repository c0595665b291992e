import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { inflateSync } from 'node:zlib';
import { describe, expect, it } from 'vitest';
import type { Sample } from '../../examples/characters/example.ts';
import { makeSamples, type SampleListing, sampleFiles, sampleFolder } from '../../examples/characters/examples.ts';
import { readAnim } from '../../src/formats/anim/read.ts';
import { readMorph } from '../../src/formats/morph/read.ts';
import { readRig } from '../../src/formats/rig/read.ts';
import { SKEL_TYPES } from '../../src/formats/skel/joint-types.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { readSkin } from '../../src/formats/skin/read.ts';
import type { Diagnostic } from '../../src/model/diagnostic.ts';
import { firstDofs, jointDofCount } from '../../src/model/skeleton/dofs.ts';
import { jointTypeOf } from '../../src/model/skeleton/joint-types.ts';
import { SCALE_MODES } from '../../src/model/skeleton/skeleton.ts';
import { textureNames } from '../../src/model/skin.ts';
import { withAutoRecognised } from '../../src/model/takes/auto-slope.ts';
import { keysOf } from '../../src/model/takes/take.ts';

const FOLDER = fileURLToPath(new URL('../../public/samples/', import.meta.url));
const samples = makeSamples();
const folder = sampleFolder();

const bytesOf = (content: string | Uint8Array) =>
  typeof content === 'string' ? new TextEncoder().encode(content) : content;

function readAny(name: string, content: string | Uint8Array): readonly Diagnostic[] {
  if (typeof content !== 'string') return [];
  if (name.endsWith('.skel')) return readSkel(content, name).diagnostics;
  if (name.endsWith('.skin')) return readSkin(content, name).diagnostics;
  if (name.endsWith('.morph')) return readMorph(content, name).diagnostics;
  if (name.endsWith('.anim')) return readAnim(content, name).diagnostics;
  return readRig(content, name).diagnostics;
}

describe('the folder of samples', () => {
  it.each([...folder.keys()])('%s in the repository is what the code makes (if not: npm run examples)', (name) => {
    expect(existsSync(FOLDER + name)).toBe(true);
    const made = bytesOf(folder.get(name) ?? '');
    expect(Buffer.compare(readFileSync(FOLDER + name), made)).toBe(0);
  });

  it('the folder of examples holds nothing else, and is under 400 kB', () => {
    expect(readdirSync(FOLDER).sort()).toEqual([...folder.keys()].sort());
    const bytes = [...folder.values()].reduce((sum, content) => sum + bytesOf(content).length, 0);
    expect(bytes).toBeLessThan(400_000);
  });

  it('lists every file of every example, the walker first', () => {
    // JSON written by the code itself.
    const entries = JSON.parse(String(folder.get('samples.json'))) as SampleListing[];
    expect(entries.map((e) => e.id)).toEqual(['walker', 'crawler', 'joints', 'tangents', 'cube']);
    const listed = entries.flatMap((e) => e.files);
    expect(listed.toSorted()).toEqual([...folder.keys()].filter((n) => n !== 'samples.json').toSorted());
  });
});

describe.each(samples.map((s) => [s.id, s] as const))('%s', (_id, sample) => {
  const files = sampleFiles(sample);

  it('the folder of samples is read without a single diagnostic', () => {
    for (const [name, content] of files) expect(readAny(name, content)).toEqual([]);
  });

  it('reads back as generated', () => {
    const { skeleton, skin, morphs, take, rig } = sample;
    const text = (name: string) => String(files.get(name));
    expect(readSkel(text(`${skeleton.name}.skel`), `${skeleton.name}.skel`).value).toEqual([skeleton]);
    if (skin) expect(readSkin(text(`${skin.name}.skin`), `${skin.name}.skin`).value).toEqual(skin);
    for (const morph of morphs)
      expect(readMorph(text(`${morph.name}.morph`), `${morph.name}.morph`).value).toEqual(morph);
    // Slopes that are those of auto tangents are read as such.
    const channels = take.channels.map((channel) => (channel.kind === 'keys' ? withAutoRecognised(channel) : channel));
    expect(readAnim(text(`${take.name}.anim`), `${take.name}.anim`).value).toEqual({ ...take, channels });
    expect(readRig(text(`${sample.id}.rig`), `${sample.id}.rig`).value).toEqual(rig);
  });

  it('the folder of samples has a rig that names its other files and no others', () => {
    const { skeleton, skin, morphs, animation } = sample.rig;
    const named = [skeleton, skin, ...morphs, animation].filter((n) => n !== undefined);
    const others = [...files.keys()].filter((n) => !n.endsWith('.rig') && !n.endsWith('.png'));
    expect(named.toSorted()).toEqual(others.toSorted());
  });

  it('the folder of samples has a channel for every DOF, and keys within the limits', () => {
    const { skeleton, morphs, take } = sample;
    expect(take.channels.length).toBe(3 + jointDofCount(skeleton) + morphs.length);
    const first = firstDofs(skeleton);
    skeleton.joints.forEach((joint, j) => {
      joint.limits.forEach(({ min, max }, i) => {
        const { values } = keysOf(take.channels[first[j] + i]);
        expect(
          [...values].filter((value) => !(value >= min && value <= max)),
          joint.name,
        ).toEqual([]);
      });
    });
  });

  if (sample.skin) skinTests(sample, sample.skin);
});

function skinTests(sample: Sample, skin: NonNullable<Sample['skin']>): void {
  it('the folder of samples has weights of 1 to 4 attachments that sum to 1, on joints that there are', () => {
    const { start, joints, weights } = skin.attachments ?? { start: [], joints: [], weights: [] };
    expect(start.length).toBe(skin.positions.length / 3 + 1);
    const wrong: string[] = [];
    for (let v = 0; v + 1 < start.length; v++) {
      let sum = 0;
      for (let a = start[v]; a < start[v + 1]; a++) sum += weights[a];
      const count = start[v + 1] - start[v];
      if (!(Math.abs(sum - 1) < 1e-9 && count >= 1 && count <= 4)) wrong.push(`vertex ${v}: ${count} sum to ${sum}`);
    }
    expect(wrong).toEqual([]);
    expect([...joints].filter((joint) => !(joint < sample.skeleton.joints.length))).toEqual([]);
    expect(skin.bindings.length).toBe(16 * sample.skeleton.joints.length);
  });

  it('the folder of samples has unit normals and texture coordinates inside the picture', () => {
    const { normals = [], texcoords = [] } = skin;
    expect(normals.length).toBe(skin.positions.length);
    const lengths = Array.from({ length: normals.length / 3 }, (_, v) =>
      Math.hypot(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]),
    );
    expect(lengths.filter((length) => !(Math.abs(length - 1) < 0.02))).toEqual([]);
    expect([...texcoords].filter((t) => !(t >= 0 && t <= 1))).toEqual([]);
  });

  it('the folder of samples has a texture that is a well-formed PNG of its own size', () => {
    const [texture] = sample.textures;
    expect(textureNames(skin)).toEqual([texture.name]);
    const png = Buffer.from(texture.bytes);
    expect(png.subarray(0, 8).toString('latin1')).toBe('\x89PNG\r\n\x1a\n');
    const size = png.readUInt32BE(16);
    const chunks = new Map<string, Buffer>();
    for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
      chunks.set(png.toString('latin1', at + 4, at + 8), png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
    }
    expect([...chunks.keys()]).toEqual(['IHDR', 'PLTE', 'IDAT', 'IEND']);
    const rows = inflateSync(chunks.get('IDAT') ?? Buffer.alloc(0));
    expect(rows.length).toBe(size * (size + 1));
    const colours = (chunks.get('PLTE')?.length ?? 0) / 3;
    expect(rows.every((index) => index < colours)).toBe(true);
  });
}

describe('tangents', () => {
  it('tangents has every kind of extrapolation and every kind of tangent', () => {
    const { take } = samples.find((s) => s.id === 'tangents') ?? samples[0];
    const moving = take.channels.filter((c) => keysOf(c).times.length > 1);
    expect(moving.map((c) => c.extrapolateOut)).toEqual(['linear', 'constant', 'cycle', 'bounce', 'cycle_offset']);
    expect(new Set(moving.flatMap((c) => [...keysOf(c).tangentsIn.kinds, ...keysOf(c).tangentsOut.kinds]))).toEqual(
      new Set([0, 1, 2, 3]),
    );
    for (const channel of moving) {
      expect(take.range[0]).toBeLessThan(keysOf(channel).times[0]);
      expect(take.range[1]).toBeGreaterThan(keysOf(channel).times[keysOf(channel).times.length - 1]);
    }
  });
});

describe('cube', () => {
  it('cube is one joint', () => {
    expect(samples.find((s) => s.id === 'cube')?.skeleton.joints.length).toBe(1);
  });
});

describe('joint types', () => {
  const sample = samples.find((s) => s.id === 'joints') ?? samples[0];
  const { skeleton, take } = sample;

  it('the joint types are all there, every mode of a scale, a coupled DOF and a bone with a length too', () => {
    const types = new Set(skeleton.joints.map(({ motion }) => jointTypeOf(motion).keyword));
    // Bones come from the files of another course.
    const all = SKEL_TYPES.map(({ keyword }) => keyword).filter((keyword) => keyword !== 'bone');
    expect(types).toEqual(new Set(all));
    const modes = skeleton.joints.flatMap(({ motion }) => (motion.kind === 'scale' ? [motion.mode] : []));
    expect(new Set(modes)).toEqual(new Set(SCALE_MODES));
    expect(skeleton.joints.some((joint) => joint.couples)).toBe(true);
    expect(skeleton.joints.some((joint) => joint.length !== undefined)).toBe(true);
  });

  it('joint types move every DOF, except carriers and linked DOFs', () => {
    const first = firstDofs(skeleton);
    skeleton.joints.forEach((joint, j) => {
      const count = joint.motion.kind === 'fixed' ? 0 : joint.pose.length;
      for (let d = 0; d < count && !joint.couples; d++) {
        const { values } = keysOf(take.channels[first[j] + d]);
        expect(Math.max(...values) - Math.min(...values)).toBeGreaterThan(0.2);
      }
    });
  });

  it('joint types switch joint names on', () => {
    const entries: SampleListing[] = JSON.parse(String(folder.get('samples.json')));
    expect(entries.find(({ id }) => id === 'joints')?.shows).toEqual({ names: true });
    expect(new Set(skeleton.joints.map(({ name }) => name)).size).toBe(skeleton.joints.length);
  });
});
