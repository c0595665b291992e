/** Layers on the command line, against the reference's numbers. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, expect, it } from 'vitest';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { command, commandJson, type PoseJson } from '../helpers/command.ts';
import { jointsInThree } from '../helpers/glb.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

interface Craft {
  readonly epsilon: number;
  readonly layers: readonly LayersCase[];
  readonly flatten: readonly FlattenCase[];
  readonly bvh: readonly BvhCase[];
  readonly glb: readonly GlbCase[];
  readonly diagnostics: readonly DiagnosticCase[];
}
interface LayersCase {
  readonly files: readonly string[];
  readonly times: readonly number[];
  readonly channels: readonly (readonly number[])[];
  readonly world?: readonly (readonly (readonly number[])[])[];
}
interface FlattenCase extends LayersCase {
  readonly range: readonly [number, number];
  readonly how: readonly ('base' | 'exact' | 'window' | 'fit')[];
  readonly keys: readonly (readonly number[] | null)[];
  readonly extrapolate: readonly (readonly string[] | null)[];
  readonly values: readonly (readonly number[])[];
  readonly length: readonly boolean[];
  readonly size: number;
}
interface BvhCase {
  readonly files: readonly string[];
  readonly frames: readonly number[];
  readonly names: readonly string[];
  readonly positions: readonly (readonly (readonly number[])[])[];
}
interface GlbCase {
  readonly files: readonly string[];
  readonly start: number;
  readonly times: readonly number[];
  readonly size: number;
  /** By time, joints in the skeleton's order. */
  readonly positions: readonly (readonly (readonly number[])[])[];
}
interface DiagnosticCase {
  readonly files: readonly string[];
  readonly code: string | null;
  readonly severity: string;
  readonly says?: string;
  /** Joint, DOF of it, value. */
  readonly dof?: readonly [number, number, number];
  readonly options?: readonly string[];
}
interface KeysJson {
  readonly channels: readonly (readonly number[])[];
  readonly keys: readonly (readonly { readonly time: number }[] | null)[];
}

const isOfLayers = ({ files }: { readonly files: readonly string[] }) => !files.some((f) => f.endsWith('.limbs.json'));
const nameOf = (files: readonly string[]) => files.find((file) => file.endsWith('.layers.json')) ?? '';

describeShared('layers of the reference files', () => {
  const craft = conformance<Craft>('craft.json');
  const shared = sharedPath('');
  const folder = mkdtempSync(join(tmpdir(), 'marrow-layers-'));
  afterAll(() => rmSync(folder, { recursive: true }));
  const named = <T extends { readonly files: readonly string[] }>(cases: readonly T[]) =>
    cases.filter(isOfLayers).map((one) => ({ ...one, name: nameOf(one.files) }));

  it.each(named(craft.layers))(
    '$name has the reference’s sums and poses',
    async ({ files, times, channels, world }) => {
      const found = await commandJson<KeysJson>(['channels', ...files, '--times', times.join(',')], shared);
      expectClose(found.channels.flat(), channels.flat(), WITHIN.reference, 'channels');
      if (!world) return;
      const { frames } = await commandJson<{ readonly frames: readonly PoseJson[] }>(
        ['pose', ...files, '--times', times.join(',')],
        shared,
      );
      const matrices = frames.flatMap((frame) => frame.characters[0].joints.flatMap((joint) => joint.world));
      expectClose(matrices, world.flat(2), WITHIN.reference, 'world');
    },
  );

  it.each(named(craft.flatten))('$name is flattened as the reference is', async (one) => {
    const { files, times, range, how, keys, extrapolate, values, length, size } = one;
    const out = join(folder, 'out.anim');
    const { code, err } = await command(['convert', ...files, out], shared);
    expect(code, err).toBe(0);
    if (how.includes('window')) expect(err).toContain('extrapolation-baked');
    const read = await commandJson<KeysJson>(['channels', out, '--times', times.join(',')], shared);
    const text = readFileSync(out, 'utf8');
    const sides = [...text.matchAll(/extrapolate (\w+) (\w+)/g)].map(([, before, after]) => [before, after]);
    const layered = await commandJson<KeysJson>(['channels', ...files, '--times', '0'], shared);
    how.forEach((kind, c) => {
      const own = read.keys[c]?.map(({ time }) => time) ?? [];
      const expected = keys[c];
      if (kind === 'fit') {
        expect(layered.keys[c]).toBeNull();
        const tolerance = craft.epsilon * (length[c] ? size : 1);
        times.forEach((time, t) => {
          if (time < range[0] || time > range[1]) return;
          expect(Math.abs(read.channels[c][t] - values[c][t]), `channel ${c} at ${time}`).toBeLessThan(tolerance);
        });
        return;
      }
      expect(own.length, `keys of channel ${c}`).toBe(expected?.length);
      expectClose(own, expected ?? [], 1e-9, `times of channel ${c}`);
      expect(sides[c]).toEqual(extrapolate[c]);
      expect(layered.keys[c]?.length).toBe(own.length);
      const [from, to] = kind === 'window' ? [own[0], own[own.length - 1]] : [-Infinity, Infinity];
      const seen = times.flatMap((time, t) => (time >= from && time <= to ? [t] : []));
      expectClose(
        seen.map((t) => read.channels[c][t]),
        seen.map((t) => values[c][t]),
        WITHIN.reference,
        `channel ${c} (${kind})`,
      );
    });
  });

  it.each(named(craft.bvh))(
    '$name is written to a capture at its frames',
    async ({ files, frames, names, positions }) => {
      const out = join(folder, 'out.bvh');
      const { code, err } = await command(['convert', ...files, out], shared);
      expect(code, err).toBe(0);
      for (const [f, frame] of frames.entries()) {
        const { characters } = await commandJson<PoseJson>(['pose', out, '--frame', String(frame)], shared);
        const found = names.map((name) =>
          characters[0].joints.find((joint) => joint.name === name)?.world.slice(12, 15),
        );
        expectClose(
          found.flatMap((at) => at ?? []),
          positions[f].flat(),
          1e-5,
          `frame ${frame}`,
        );
      }
    },
  );

  it.each(named(craft.glb))('$name as GLB moves in three.js as the reference does', async (one) => {
    const { files, start, times, size, positions } = one;
    const out = join(folder, 'out.glb');
    const { code, err } = await command(['convert', ...files, '--raw', out], shared);
    expect(code, err).toBe(0);
    const skeleton = await commandJson<PoseJson>(['pose', ...files, '--time', '0'], shared);
    const names = skeleton.characters[0].joints.map(({ name }) => name);
    const placesAt = await jointsInThree(readFileSync(out), names);
    times.forEach((time, t) => {
      const found = placesAt(time - start);
      positions[t].forEach((place, j) => {
        const off = Math.hypot(...place.map((value, k) => found[j][k] - value));
        expect(off, `${names[j]} at ${time}`).toBeLessThan(craft.epsilon * size);
      });
    });
  });

  it.each(named(craft.diagnostics).map((one) => ({ ...one, call: (one.options ?? []).join(' ') })))(
    '$name $call tells $code',
    async ({ files, code, severity, says, dof, options = [] }) => {
      const args = ['pose', ...files, '--time', '0', ...options];
      const found = await commandJson<PoseJson>(args, shared, severity === 'error' ? 1 : 0);
      const [first] = found.diagnostics.filter((d) => d.severity === severity || d.code === code);
      if (code === null) expect(found.diagnostics.filter((d) => d.severity !== 'info')).toEqual([]);
      else {
        expect(first).toMatchObject({ code, severity });
        expect(first.file).toBe(nameOf(files));
        expect(first.message + (first.assumed ?? '')).toContain(says ?? '');
      }
      if (!dof) return;
      const [joint, index, value] = dof;
      expect(found.characters[0].joints[joint].dofs[index]).toBeCloseTo(value, 9);
    },
  );
});
