/**
 * Which values of the document came out of which opened file. A document shares everything that was not edited with
 * what was read, by identity; so a value that is known here need not be kept again: the file is, and the way to it.
 *
 * Known are the parts of a file at every depth: of a skeleton one joint of which has other limits, all other joints
 * still are the file's.
 */
import type { KeptFile } from '../../io/session-store.ts';
import type { ParsedFile } from '../../model/files.ts';
import type { GivenBlob } from '../../worker/protocol.ts';

/** A file as it was given; as it is kept. */
export type Given = KeptFile;

/** One of the files read of what was given: a zip holds several. */
export interface OriginFile {
  readonly given: Given;
  /** `source.path`. */
  readonly path: string;
}

/** A step of the way from a file to a part of it; that of the file itself has no `key`. */
interface Origin {
  readonly file: OriginFile;
  readonly up: Origin | undefined;
  readonly key: string | number;
}

export type PathKey = string | number;

export class Origins {
  /** Holds on to nothing of the files: parts that nobody uses any more may go. */
  private readonly known = new WeakMap<object, Origin>();
  /** Given files whose Blobs can't be kept: all that came from them is kept as if it were made here. */
  private readonly unkeepable = new WeakSet<Given>();

  /** @param nextId given files are counted from here on: above the ids of all that may be adopted */
  constructor(private nextId = 1) {}

  /** Files were opened. */
  learn(given: readonly GivenBlob[], files: readonly ParsedFile[]): void {
    const opening = this.nextId;
    // Where a file lies on disk, and what else is known of it, is no part of what is read again.
    const all = given.map(({ path, blob }): Given => ({ id: this.nextId++, opening, given: { path, blob } }));
    this.adopt(all, files);
  }

  /** The same for files that were kept, and have their ids already. */
  adopt(given: readonly Given[], files: readonly ParsedFile[]): void {
    for (const file of files) {
      const found = givenOf(file, given);
      if (found) this.walk(file, { file: { given: found, path: file.source.path }, up: undefined, key: '' });
    }
  }

  setKeepable(given: Given, keepable: boolean): void {
    if (keepable) this.unkeepable.delete(given);
    else this.unkeepable.add(given);
  }

  /** Where a value came from: its file, and the keys that lead to it from there. */
  find(value: object): { readonly file: OriginFile; readonly path: readonly PathKey[] } | undefined {
    const origin = this.known.get(value);
    if (!origin || this.unkeepable.has(origin.file.given)) return undefined;
    const path: PathKey[] = [];
    for (let at: Origin | undefined = origin; at?.up; at = at.up) path.unshift(at.key);
    return { file: origin.file, path };
  }

  private walk(value: object, origin: Origin): void {
    // What two files share is found in the first.
    if (this.known.has(value)) return;
    this.known.set(value, origin);
    if (ArrayBuffer.isView(value)) return;
    const step = (key: PathKey, inner: unknown) => {
      if (typeof inner === 'object' && inner !== null) this.walk(inner, { file: origin.file, up: origin, key });
    };
    if (Array.isArray(value)) for (const [index, inner] of value.entries()) step(index, inner);
    else for (const [key, inner] of Object.entries(value)) step(key, inner);
  }
}

/** The one given file that a file was read of; none where that is not certain. */
export function givenOf(file: ParsedFile, given: readonly Given[]): Given | undefined {
  const { path } = file.source;
  const fitting = given.filter((g) => g.given.path === path || path.startsWith(`${g.given.path}/`));
  return fitting.length === 1 ? fitting[0] : undefined;
}
