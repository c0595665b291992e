/** Runs the command as a function, with what it prints kept. */
import { sep } from 'node:path';
import { run } from '../../src/cli/run.ts';
import type { Diagnostic } from '../../src/model/diagnostic.ts';

export interface CommandResult {
  readonly code: number;
  readonly out: string;
  readonly err: string;
}

/** @param folder absolute: what paths in the arguments are relative to */
export async function command(args: readonly string[], folder = process.cwd()): Promise<CommandResult> {
  let out = '';
  let err = '';
  const code = await run(args, {
    folder: folder.endsWith(sep) ? folder.slice(0, -1) : folder,
    out: async (text) => {
      out += text;
    },
    err: (text) => {
      err += text;
    },
  });
  return { code, out, err };
}

/** What `info`, `pose` and `channels` print with `--json`: the parts that tests look at. */
export interface InfoJson {
  readonly files: readonly { readonly name: string; readonly kind: string; readonly [count: string]: unknown }[];
  readonly diagnostics: readonly Diagnostic[];
}

export interface PoseJson {
  readonly characters: readonly {
    readonly name: string;
    readonly root: readonly number[];
    readonly joints: readonly {
      readonly index: number;
      readonly name: string;
      readonly parent: number;
      readonly type: string;
      readonly dofs: readonly number[];
      readonly world: readonly number[];
      readonly tip?: readonly number[];
    }[];
    readonly endSites?: readonly { readonly joint: number; readonly position: readonly number[] }[];
    readonly morphs: readonly { readonly name: string; readonly weight: number }[];
    readonly positions?: readonly number[];
    readonly normals?: readonly number[];
    readonly bounds: { readonly min: readonly number[]; readonly max: readonly number[] } | null;
  }[];
  readonly diagnostics: readonly Diagnostic[];
}

export interface ChannelsJson {
  readonly channels: readonly (readonly number[])[];
  readonly diagnostics: readonly Diagnostic[];
}

/** @throws Error with what the command said, where it gave no JSON or another exit code than expected */
export async function commandJson<T>(args: readonly string[], folder?: string, code = 0): Promise<T> {
  const result = await command([...args, '--json'], folder);
  if (result.code !== code) throw new Error(`marrow ${args.join(' ')} gave ${result.code}:\n${result.err}`);
  // The shape is the command's promise; the tests check what they read of it.
  return JSON.parse(result.out) as T;
}
