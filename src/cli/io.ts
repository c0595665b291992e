/** A command's environment, so that tests can run it in-process. */
export interface CommandIo {
  /** Absolute; paths in arguments are relative to it. */
  readonly folder: string;
  /** Results. Resolves when everything is written, even into a slow pipe. */
  out(text: string): Promise<void>;
  /** Messages for people. */
  err(text: string): void;
  /** A line that the next one replaces, empty to clear it; absent if no one watches. */
  progress?(line: string): void;
  /** All of the standard input; absent if there is none. */
  input?(): Promise<string>;
  /** What other threads run; absent if there are none. */
  readonly program?: URL;
}

/** What each means is said by the command's `exits`. */
export type ExitCode = 0 | 1 | 2 | 3;

/** The outcomes of a command, in words, by exit code. 2 is always wrong usage. */
export type Exits = Readonly<Partial<Record<ExitCode, string>>> & { readonly 0: string };

/** Of commands that read files and print what is in them. */
export const FILE_EXITS: Exits = { 0: 'all files were read', 1: 'a file has errors or is missing', 2: 'wrong usage' };
