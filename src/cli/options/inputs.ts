/** What a command takes besides options: files, or a folder. */
import { UsageError } from '../usage-error.ts';

/** Inputs whose value in `run` is a T. */
export interface Inputs<T> {
  /** How they are written in usage, all ways to write them: `FILE…`. */
  readonly forms: readonly string[];
  /** What each word in capitals stands for, in a sentence. */
  readonly terms: Readonly<Record<string, string>>;
  /** @throws UsageError if there are too few or too many */
  read(given: readonly string[], command: string): T;
}

/** What `FILE` stands for in most commands. */
export const ANY_FILE = 'A file of a character, or a folder or zip, of which all files are read.';

/** At least one. */
export function files(form: string, terms: Readonly<Record<string, string>>): Inputs<readonly string[]> {
  return {
    forms: [form],
    terms,
    read(given) {
      if (given.length === 0) throw new UsageError('Give at least one file.');
      return given;
    },
  };
}

/** Any number of them, which the command checks itself, as options may take their place. */
export function anyInputs(
  forms: readonly string[],
  terms: Readonly<Record<string, string>>,
): Inputs<readonly string[]> {
  return { forms, terms, read: (given) => given };
}

/** One folder. @param what it is, to end "grade takes one": `folder of submissions` */
export function oneFolder(placeholder: string, what: string, explained: string): Inputs<string> {
  return {
    forms: [placeholder],
    terms: { [placeholder]: explained },
    read(given, command) {
      const [folder, ...others] = given;
      if (folder === undefined || others.length > 0) throw new UsageError(`${command} takes one ${what}.`);
      return folder;
    },
  };
}
