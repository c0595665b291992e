/** Runs the command as a function and captures its output. */
import { sep } from 'node:path';
import { run } from '../../src/cli/run.ts';
import type { Diagnostic } from '../../src/model/diagnostic.ts';

export interface CommandResult {
  readonly code: number;
  readonly out: string;
  readonly err: string;
}

/**
 * @param folder absolute; paths in the arguments are relative to it
 * @param input the standard input
 */
export async function command(
  args: readonly string[],
  folder = process.cwd(),
  input?: () => Promise<string>,
): Promise<CommandResult> {
  let out = '';
  let err = '';
  const code = await run(args, {
    ...(input && { input }),
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

/** The parts of the JSON output of `info`, `pose` and `channels` that tests read. */
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
      readonly local?: readonly number[];
      readonly skinning?: readonly number[];
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

/** @throws Error with the command's messages, if it printed no JSON or had another exit code */
export async function commandJson<T>(args: readonly string[], folder?: string, code = 0): Promise<T> {
  const result = await command([...args, '--json'], folder);
  if (result.code !== code) throw new Error(`marrow ${args.join(' ')} gave ${result.code}:\n${result.err}`);
  // The command's documented shape; tests check what they read of it.
  return JSON.parse(result.out) as T;
}
