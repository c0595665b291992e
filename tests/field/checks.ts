/** What `check` of a case asks of the command. */
import { readdirSync, readFileSync } from 'node:fs';
import { basename, extname, join } from 'node:path';
import { expect } from 'vitest';
import type { Diagnostic } from '../../src/model/diagnostic.ts';
import { type CommandResult, command, type PoseJson } from '../helpers/command.ts';

type Vec3 = readonly number[];

export interface FieldCase {
  readonly case: string;
  readonly check: keyof typeof CHECKS;
  readonly files: readonly string[];
  readonly options?: readonly string[];
  readonly times?: readonly number[];
  readonly values?: readonly (readonly number[])[];
  readonly said?: 'nothing' | 'warning';
  readonly line?: number;
  readonly column?: number;
  readonly lines?: readonly number[];
  /** A regular expression, or several. */
  readonly words?: string | readonly string[];
  readonly exit?: number;
  readonly joints?: unknown;
  readonly vertices?: number;
  readonly positions?: readonly Vec3[];
  readonly ground?: number;
  readonly unit?: string | null;
  readonly flagged?: boolean;
  readonly worst?: readonly [number, number];
  readonly to?: string;
  readonly stems?: readonly string[];
  readonly ending?: string;
  readonly of?: string;
  readonly fps?: number;
  readonly seconds?: number;
  readonly deep?: number;
  readonly silent?: string;
  readonly tolerance?: number;
  readonly vertex?: number;
  readonly position?: Vec3;
  readonly errors?: number;
  readonly agrees?: boolean;
  readonly code?: readonly string[];
  readonly new?: readonly string[];
  readonly compared?: Readonly<Record<string, number>>;
  readonly first?: number | null;
  readonly never?: string;
  readonly verdicts?: Readonly<Record<string, string>>;
  readonly count?: number;
  readonly command?: string;
  readonly names?: readonly [string, string];
}

interface Told extends CommandResult {
  readonly diagnostics: readonly Diagnostic[];
  // The shape is that of the command which was asked.
  // biome-ignore lint/suspicious/noExplicitAny: each check reads what its command documents
  readonly json: any;
}

async function ask(args: readonly string[], folder: string): Promise<Told> {
  const result = await command([...args, '--json'], folder);
  const json = /^\s*[[{]/.test(result.out) ? JSON.parse(result.out) : undefined;
  return { ...result, json, diagnostics: json?.diagnostics ?? [] };
}

const wordsOf = ({ words = [] }: FieldCase) => [words].flat().map((text) => new RegExp(text, 'i'));
const saidBy = (told: Told) => `${told.err}\n${told.diagnostics.map(({ message }) => message).join('\n')}`;
const errorsOf = (told: Told) => told.diagnostics.filter(({ severity }) => severity === 'error');
const isTold = (one: FieldCase, told: Told) => wordsOf(one).every((words) => words.test(saidBy(told)));

function expectSaid(one: FieldCase, told: Told): void {
  const severities = new Set(told.diagnostics.map(({ severity }) => severity));
  if (one.said === 'nothing') expect([...severities].filter((severity) => severity !== 'info')).toEqual([]);
  if (one.said === 'warning') expect([severities.has('warning'), severities.has('error')]).toEqual([true, false]);
}

/** World positions of joints by name, of the only character. */
function expectJoints(told: Told, joints: Readonly<Record<string, Vec3>>): void {
  const { characters } = told.json as PoseJson;
  const all = characters.flatMap((character) => character.joints);
  const size = Math.max(...all.flatMap(({ world }) => world.slice(12, 15).map(Math.abs)));
  for (const [name, position] of Object.entries(joints)) {
    const joint = all.find((other) => other.name === name);
    expect(joint, name).toBeDefined();
    expectNear(joint?.world.slice(12, 15) ?? [], position, 1e-6 * size, name);
  }
}

function expectNear(found: Vec3, expected: Vec3, tolerance: number, what: string): void {
  const error = Math.max(...expected.map((value, i) => Math.abs(value - (found[i] ?? Number.NaN))));
  expect(error, `${what}: ${found} instead of ${expected}`).toBeLessThanOrEqual(tolerance);
}

async function channels(one: FieldCase, folder: string): Promise<void> {
  const told = await ask(['channels', ...one.files, '--times', String(one.times)], folder);
  expect(told.code, told.err).toBe(0);
  const found = told.json.channels as number[][];
  expect(found).toHaveLength(one.values?.length ?? 0);
  for (const [i, values] of (one.values ?? []).entries()) expectNear(found[i] ?? [], values, 1e-9, `channel ${i}`);
  expectSaid(one, told);
}

async function pose(one: FieldCase, folder: string): Promise<Told> {
  const told = await ask(['pose', ...one.files, ...(one.options ?? [])], folder);
  expect(told.code, told.err).toBe(0);
  expectJoints(told, one.joints as Readonly<Record<string, Vec3>>);
  expectSaid(one, told);
  return told;
}

async function either(first: () => Promise<unknown>, other: () => Promise<boolean>): Promise<void> {
  try {
    await first();
  } catch (error) {
    if (!(await other())) throw error;
  }
}

const info = (one: FieldCase, folder: string) => ask(['info', ...one.files], folder);

async function unread(one: FieldCase, folder: string): Promise<void> {
  for (const name of ['info', 'pose']) {
    const told = await ask([name, ...one.files], folder);
    expect(told.code, name).not.toBe(0);
    expect(saidBy(told).trim()).not.toBe('');
    if (one.errors !== undefined) expect(errorsOf(told).length).toBeLessThanOrEqual(one.errors);
  }
}

async function exported(one: FieldCase, folder: string, out: string) {
  const { code, err } = await command(
    ['export', ...one.files, '--to', 'json', '--out', out, ...(one.options ?? [])],
    folder,
  );
  expect(code, err).toBe(0);
  const name = filesIn(out).find((file) => file.endsWith('.json')) ?? '';
  return JSON.parse(readFileSync(join(out, name), 'utf8'));
}

interface Reviewed {
  readonly fps: number;
  readonly flags: readonly string[];
  /** How large the worst flag is. */
  readonly worst?: number;
  readonly unit?: string;
}

async function reviewed(one: FieldCase, folder: string) {
  const { code, out, err } = await command(['review', ...one.files, '--json'], folder);
  expect(code, err).toBe(0);
  return JSON.parse(out)[0] as Reviewed;
}

const filesIn = (folder: string) => readdirSync(folder, { recursive: true, encoding: 'utf8' }).sort();

async function glb(folder: string, out: string, args: readonly string[]) {
  const path = join(out, 'out.glb');
  const told = await ask(['convert', ...args, path], folder);
  expect(told.code, told.err).toBe(0);
  const bytes = readFileSync(path);
  const length = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.subarray(20, 20 + length).toString()), told };
}

async function compared(one: FieldCase, folder: string): Promise<void> {
  const told = await ask(['compare', ...one.files, ...(one.options ?? [])], folder);
  const { json } = told;
  expect(json?.agrees, saidBy(told)).toBe(one.agrees);
  expect(told.code).toBe(one.agrees ? 0 : 1);
  expect(json.compared).toMatchObject(one.compared ?? {});
  if (one.first === null) expect(json.first ?? null).toBeNull();
  if (typeof one.first === 'number') expect(json.first.index).toBe(one.first);
  const [cause] = json.causes;
  if (one.code) {
    if (one.code.length === 0) expect(json.causes).toEqual([]);
    else expect(one.code).toContain(cause?.code);
  }
  if (one.new) {
    expect(cause, 'a cause').toBeDefined();
    expect(cause.explains).toBe(cause.of);
    const { out } = await command(['compare', ...one.files, ...(one.options ?? [])], folder);
    for (const words of one.new) expect(`${JSON.stringify(cause)}\n${out}`).toMatch(new RegExp(words, 'i'));
  }
}

/** Angle between two vectors, in degrees. */
function angleBetween(a: Vec3, b: Vec3): number {
  const dot = a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
  return (Math.acos(Math.max(-1, Math.min(1, dot / (Math.hypot(...a) * Math.hypot(...b))))) * 180) / Math.PI;
}

async function feet(file: string, frame: number, names: string, folder: string): Promise<Vec3[]> {
  const told = await ask(['pose', file, '--frame', String(frame)], folder);
  const { joints } = (told.json as PoseJson).characters[0] ?? { joints: [] };
  // The cases name joints without their namespace.
  const at = (name: string) => joints.find((joint) => joint.name.split(':').at(-1) === name)?.world.slice(12, 15) ?? [];
  const [leftFoot = '', leftToe = '', rightFoot = '', rightToe = ''] = names.split(' ');
  return [
    [leftFoot, leftToe],
    [rightFoot, rightToe],
  ].map(([foot = '', toe = '']) => {
    const ankle = at(foot);
    return at(toe).map((value, i) => value - (ankle[i] ?? 0));
  });
}

const median = (values: readonly number[]) => [...values].sort((a, b) => a - b)[values.length >> 1] ?? Number.NaN;

export const CHECKS = {
  channels,

  'channels or told': (one: FieldCase, folder: string) =>
    either(
      () => channels(one, folder),
      async () =>
        (await info(one, folder)).diagnostics.some(({ line, column }) => line === one.line && column === one.column),
    ),

  async refused(one: FieldCase, folder: string) {
    const told = await info(one, folder);
    expect(told.code).toBe(1);
    const errors = errorsOf(told);
    expect(errors).not.toEqual([]);
    if (one.line !== undefined)
      expect(errors).toContainEqual(expect.objectContaining({ line: one.line, column: one.column }));
    for (const words of wordsOf(one)) expect(errors.map(({ message }) => message).join('\n')).toMatch(words);
  },

  async opens(one: FieldCase, folder: string) {
    const told = await info(one, folder);
    expect(told.code).toBe(one.exit);
    const [character] = told.json.characters;
    expect(character?.joints).toBe(one.joints);
    expect(character.skins).toHaveLength(1);
    const posed = await ask(['pose', ...one.files, '--vertices'], folder);
    expect(posed.json.characters[0].positions).toHaveLength(3 * (one.vertices ?? 0));
  },

  pose,

  async told(one: FieldCase, folder: string) {
    const found = (await info(one, folder)).diagnostics.filter(({ severity }) => severity !== 'info');
    expect(found.some(({ line }) => one.lines?.includes(line ?? 0))).toBe(true);
  },

  async says(one: FieldCase, folder: string) {
    const { diagnostics } = await info(one, folder);
    expect(diagnostics.some(({ message }) => wordsOf(one).every((words) => words.test(message)))).toBe(true);
  },

  'pose or told': (one: FieldCase, folder: string) =>
    either(
      () => pose(one, folder),
      async () => isTold(one, await info(one, folder)),
    ),

  'pose or said': (one: FieldCase, folder: string) =>
    either(
      () => pose(one, folder),
      async () => isTold(one, await info(one, folder)),
    ),

  async export(one: FieldCase, folder: string, out: string) {
    const { names, positions, meta } = await exported(one, folder, out);
    if (one.unit) expect(meta.unit).toBe(one.unit);
    const lowered = Object.entries(one.joints as Readonly<Record<string, Vec3>>).map(([name, position]) => {
      const found = positions[0][names.indexOf(name)] as Vec3;
      const [x = 0, y = 0, z = 0] = position;
      expectNear([found[0] ?? Number.NaN, found[2] ?? Number.NaN], [x, z], 1e-3, name);
      return y - (found[1] ?? Number.NaN);
    });
    expect(Math.max(...lowered) - Math.min(...lowered)).toBeLessThanOrEqual(1e-3);
    expect(Math.max(...lowered)).toBeLessThanOrEqual((one.ground ?? 0) + 1e-3);
    expect(Math.min(...lowered)).toBeGreaterThanOrEqual(-1e-3);
  },

  async review(one: FieldCase, folder: string) {
    const { flags, worst, unit } = await reviewed(one, folder);
    expect(flags.length > 0, flags.join('; ')).toBe(one.flagged);
    if (!one.worst) return;
    expect(unit).toBe('m');
    expect(worst).toBeGreaterThanOrEqual(one.worst[0]);
    expect(worst).toBeLessThanOrEqual(one.worst[1]);
  },

  async names(one: FieldCase, folder: string, out: string) {
    const { code, err } = await command(['convert', ...one.files, '--to', one.to ?? '', '--out', out], folder);
    expect(code, err).toBe(0);
    const files = filesIn(out);
    for (const stem of one.stems ?? []) {
      const written = files.filter((file) => file.endsWith(one.ending ?? '') && file.includes(stem));
      expect(written, files.join(', ')).toHaveLength(1);
      if (!one.of) continue;
      const owners = files.filter((file) => extname(file) === one.of);
      const name = (file: string) => file.slice(0, -extname(file).length);
      expect(owners.some((owner) => name(written[0] ?? '').startsWith(name(owner)) && owner.includes(stem))).toBe(true);
    }
  },

  async rate(one: FieldCase, folder: string, out: string) {
    expect((await exported(one, folder, out)).fps).toBe(one.fps);
    expect((await reviewed(one, folder)).fps).toBe(one.fps);
  },

  async take(one: FieldCase, folder: string, out: string) {
    expect((await info(one, folder)).json.characters).toHaveLength(1);
    const { json } = await glb(folder, out, one.files);
    expect(json.animations).toHaveLength(1);
    const inputs = json.animations[0].samplers.map(
      ({ input }: { input: number }) => json.accessors[input].max[0] as number,
    );
    expect(Math.max(...inputs)).toBeCloseTo(one.seconds ?? 0, 4);
  },

  async body(one: FieldCase, folder: string, out: string) {
    const { json } = await glb(folder, out, one.files);
    const [primitive] = json.meshes[0].primitives;
    const { min, max } = json.accessors[primitive.attributes.POSITION];
    expect(max[2] - min[2]).toBeLessThanOrEqual(one.deep ?? 0);
  },

  async retargeted(one: FieldCase, folder: string, out: string) {
    const [take = '', target = ''] = one.files;
    const { json } = await glb(folder, out, [take, '--retarget', target]);
    expect(json.animations).toHaveLength(1);
    expect(json.skins[0].joints).toHaveLength(one.joints as number);
  },

  async bvh(one: FieldCase, folder: string, out: string) {
    const path = join(out, 'out.bvh');
    const told = await ask(['convert', ...one.files, path], folder);
    expect(told.code, told.err).toBe(0);
    expect(saidBy(told)).not.toMatch(new RegExp(one.silent ?? '$^', 'i'));
    const frames = Number(/Frames:\s*(\d+)/.exec(readFileSync(path, 'utf8'))?.[1]);
    const step = Number(/Frame Time:\s*(\S+)/.exec(readFileSync(path, 'utf8'))?.[1]);
    for (let frame = 0; frame < frames; frame++) {
      const [ours, file] = await Promise.all([
        ask(['pose', path, '--frame', String(frame)], folder),
        ask(['pose', ...one.files, '--time', String(frame * step)], folder),
      ]);
      const joints = (told: Told) => (told.json as PoseJson).characters[0]?.joints ?? [];
      const size = Math.max(...joints(file).flatMap(({ world }) => world.slice(12, 15).map(Math.abs)));
      for (const joint of joints(ours)) {
        const other = joints(file).find(({ name }) => name === joint.name);
        if (!other) continue;
        expectNear(joint.world.slice(12, 15), other.world.slice(12, 15), (one.tolerance ?? 0) * size, joint.name);
      }
    }
  },

  /** Colours are in what the page draws: the `.skin` written from it has them. */
  async emission(one: FieldCase, folder: string, out: string) {
    const told = await info(one, folder);
    if (isTold(one, told)) return;
    await command(['convert', ...one.files, '--to', 'rig', '--out', out], folder);
    const skin = filesIn(out).find((file) => file.endsWith('.skin')) ?? '';
    const [, r = '', g = '', b = ''] =
      /color\s+(\S+)\s+(\S+)\s+(\S+)/.exec(readFileSync(join(out, skin), 'utf8')) ?? [];
    expect([r, g, b].map(Number)).toEqual([0, 1, 0]);
  },

  async weights(one: FieldCase, folder: string) {
    const told = await ask(['pose', ...one.files, '--vertices'], folder);
    if (isTold({ ...one, words: '(not|without).*weight|weight.*(not|without)' }, told)) return;
    const at = 3 * (one.vertex ?? 0);
    expectNear(told.json.characters[0].positions.slice(at, at + 3), one.position ?? [], 1e-6, 'vertex');
  },

  unread,

  'read or unread': (one: FieldCase, folder: string) =>
    either(
      async () => expect((await info(one, folder)).json.characters[0].joints).toBe(one.joints),
      async () => unread(one, folder).then(() => true),
    ),

  parents: (one: FieldCase, folder: string) =>
    either(
      async () => {
        const { json } = await ask(['pose', ...one.files], folder);
        const found = (json as PoseJson).characters[0]?.joints ?? [];
        expect(found).toHaveLength(one.positions?.length ?? 0);
        for (const [i, position] of (one.positions ?? []).entries()) {
          expectNear(found[i]?.world.slice(12, 15) ?? [], position, 1e-9, `joint ${i}`);
        }
      },
      async () => isTold(one, await info(one, folder)),
    ),

  compare: compared,

  'compare or told': (one: FieldCase, folder: string) =>
    either(
      () => compared(one, folder),
      async () => isTold(one, await ask(['compare', ...one.files], folder)),
    ),

  async 'unread dump'(one: FieldCase, folder: string) {
    const told = await ask(['compare', ...one.files], folder);
    expect(told.code).toBe(2);
    expect(saidBy(told)).not.toMatch(new RegExp(one.never ?? '$^', 'i'));
  },

  async grade(one: FieldCase, folder: string) {
    const [submissions = '', reference = ''] = one.files;
    const told = await ask(['grade', submissions, '--reference', reference, ...(one.options ?? [])], folder);
    const found = new Map<string, string>(
      told.json.submissions.map(({ name, verdict }: { name: string; verdict: string }) => [name, verdict]),
    );
    for (const [name, verdict] of Object.entries(one.verdicts ?? {})) {
      if (verdict === 'not right') expect(found.get(name)).not.toBe('right');
      else expect(found.get(name)).toBe(verdict);
    }
  },

  async html(one: FieldCase, folder: string) {
    const [submissions = '', reference = ''] = one.files;
    const { out } = await command(
      ['grade', submissions, '--reference', reference, ...(one.options ?? []), '--html'],
      folder,
    );
    for (const words of wordsOf(one)) expect(out).toMatch(words);
  },

  async characters(one: FieldCase, folder: string) {
    const { json } = await info(one, folder);
    const names = json.characters.map(({ name }: { name: string }) => name);
    expect([names.length, new Set(names).size]).toEqual([one.count, one.count]);
  },

  async help(one: FieldCase, folder: string) {
    const { out } = await command([one.command ?? '', '--help'], folder);
    for (const words of wordsOf(one)) expect(out).toMatch(words);
  },

  async toes(one: FieldCase, folder: string, out: string) {
    const [source = '', target = ''] = one.files;
    const path = join(out, basename(source));
    const { code, err } = await command(['convert', source, '--retarget', target, path], folder);
    expect(code, err).toBe(0);
    const [theirs, ours] = one.names ?? ['', ''];
    const frames = Number(/Frames:\s*(\d+)/.exec(readFileSync(path, 'utf8'))?.[1]);
    const angles: [number[], number[]] = [[], []];
    for (let i = 0; i < 12; i++) {
      const frame = Math.round((i * (frames - 1)) / 11);
      const before = await feet(source, frame, theirs, folder);
      const after = await feet(path, frame, ours, folder);
      for (const side of [0, 1] as const) {
        angles[side].push(angleBetween(before[side] ?? [], after[side] ?? []));
        if ((before[side]?.[1] ?? 0) < 0) expect(after[side]?.[1], `frame ${frame}`).toBeLessThan(0);
      }
    }
    for (const side of angles) expect(median(side)).toBeLessThanOrEqual(35);
  },
};
