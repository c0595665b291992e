/** A command's environment, so that tests can run it in-process. */
export interface CommandIo {
  /** Absolute; paths in arguments are relative to it. */
  readonly folder: string;
  /** Results. Resolves when everything is written, even into a slow pipe. */
  out(text: string): Promise<void>;
  /** Messages for people. */
  err(text: string): void;
}

/** 0, or 1 when a file has errors, 2 for wrong usage. */
export type ExitCode = 0 | 1 | 2;

/** A subcommand of `marrow`. */
export interface CliCommand {
  readonly name: string;
  /** Arguments, as shown in the usage line. */
  readonly usage: string;
  /** Summary in one line. */
  readonly summary: string;
  /** @throws UsageError */
  run(args: readonly string[], io: CommandIo): Promise<ExitCode>;
}
