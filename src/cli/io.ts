/** What a command talks to, so that tests can run it without a process of its own. */
export interface CommandIo {
  /** Absolute; paths in arguments are relative to it. */
  readonly folder: string;
  /** Results. Resolves when all of it is written, into a slow pipe too. */
  out(text: string): Promise<void>;
  /** What people are told beside. */
  err(text: string): void;
}

/** 0, or 1 when a file has errors, 2 for wrong usage. */
export type ExitCode = 0 | 1 | 2;

/** One of the words after `marrow`. */
export interface CliCommand {
  readonly name: string;
  /** Its arguments, as the usage line shows them. */
  readonly usage: string;
  /** What it does, in a line. */
  readonly summary: string;
  /** @throws UsageError */
  run(args: readonly string[], io: CommandIo): Promise<ExitCode>;
}
