/**
 * Commands of the shell, each one record, and its file the only one that knows it:
 *
 *     export const channels = shellCommand({
 *       name: 'channels',
 *       summary: 'Prints the value of each channel at each time.',
 *       inputs: files('FILE.anim', { 'FILE.anim': 'One animation.' }),
 *       options: { times: option(numbers('T,T,…'), 'Evaluates …', { isRequired: true }), json: flag('Prints …') },
 *       exits: FILE_EXITS,
 *       async run({ inputs, options: { times, json } }, io) { … },
 *     });
 *
 * Its options are declared once (`option.ts`). From them come their types, the parser and its errors (`parse.ts`),
 * usage and `--help` (`help.ts`), and `docs/reference/command.md`.
 */
import type { CommandIo, ExitCode, Exits } from '../io.ts';
import type { Inputs } from './inputs.ts';
import type { Options, OptionValues } from './option.ts';
import { type Exclusive, parse } from './parse.ts';

/** Explains more than options do: a paragraph, or terms under a heading. `Code` is between backticks. */
export type Explained = string | { readonly heading: string; readonly terms: Readonly<Record<string, string>> };

/** What is said about a command. */
export interface Described<O extends Options> {
  readonly name: string;
  /** What it does, in one sentence. */
  readonly summary: string;
  readonly inputs: Inputs<unknown>;
  readonly options: O;
  /** Options of which at most one may be given. */
  readonly exclusive?: Exclusive<O>;
  readonly about?: readonly Explained[];
  /** Whole lines of a shell. */
  readonly examples?: readonly string[];
  readonly exits: Exits;
}

/** How a command is declared. */
interface Declared<O extends Options, I> extends Described<O> {
  readonly inputs: Inputs<I>;
  /** @throws UsageError for what depends on the files, or on several options */
  run(given: { readonly inputs: I; readonly options: OptionValues<O> }, io: CommandIo): Promise<ExitCode>;
}

/** A subcommand of `marrow`. */
export interface ShellCommand extends Omit<Described<Options>, 'exclusive'> {
  readonly exclusive: readonly (readonly string[])[];
  /** @throws UsageError */
  run(args: readonly string[], io: CommandIo): Promise<ExitCode>;
}

/** A command whose `run` gets inputs and options that were read and checked. */
export function shellCommand<const O extends Options, I>(declared: Declared<O, I>): ShellCommand {
  const { name, inputs, options, exclusive = [], run } = declared;
  return {
    ...declared,
    exclusive,
    async run(args, io) {
      const given = parse(args, options, exclusive);
      return run({ inputs: inputs.read(given.inputs, name), options: given.options }, io);
    },
  };
}
