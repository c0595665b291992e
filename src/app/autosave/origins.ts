/**
 * Which values of the document come from which opened file. The document shares everything unedited with what was read,
 * by identity; so a value found here need not be stored: the file and the path to it are enough.
 *
 * Parts of a file are known at every depth: after one joint's limits are edited, all other joints are still the file's.
 */
import type { KeptFile } from '../../io/session-store.ts';
import type { ParsedFile } from '../../model/files.ts';
import type { GivenBlob } from '../../worker/protocol.ts';

/** An opened file, as stored. */
export type Given = KeptFile;

/** A file read from an opened one; a zip holds several. */
export interface OriginFile {
  readonly given: Given;
  /** `source.path`. */
  readonly path: string;
}

/** A step on the path from a file to a part of it; the file itself has no `key`. */
interface Origin {
  readonly file: OriginFile;
  readonly up: Origin | undefined;
  readonly key: string | number;
}

export type PathKey = string | number;

export class Origins {
  /** Weak: doesn't keep unused parts of files alive. */
  private readonly known = new WeakMap<object, Origin>();
  /** Opened files whose Blobs can't be stored: everything from them is kept as if created here. */
  private readonly unkeepable = new WeakSet<Given>();
  /** What an opened file can't be read without, such as the buffers of a `.gltf`. */
  private readonly beside = new WeakMap<Given, ReadonlySet<Given>>();

  /** Learned, and not looked through yet. */
  private readonly learned: { readonly given: readonly Given[]; readonly files: readonly ParsedFile[] }[] = [];

  /** @param nextId first id for opened files: above the ids of all that may be adopted */
  constructor(private nextId = 1) {}

  /** Registers opened files. They are looked through with the next save: of thousands that takes a while. */
  learn(given: readonly GivenBlob[], files: readonly ParsedFile[]): void {
    const opening = this.nextId;
    // The path on disk and the like aren't needed to read the file again.
    const all = given.map(({ path, blob }): Given => ({ id: this.nextId++, opening, given: { path, blob } }));
    this.learned.push({ given: all, files });
  }

  private settle(): void {
    // Asked for each value that is stored.
    if (this.learned.length === 0) return;
    for (const { given, files } of this.learned.splice(0)) this.adopt(given, files);
  }

  /** Registers files that were kept and have ids already. */
  adopt(given: readonly Given[], files: readonly ParsedFile[]): void {
    this.settle();
    for (const file of files) {
      const found = givenOf(file, given);
      if (!found) continue;
      const others = (file.beside ?? []).flatMap(({ path }) => givenAt(path, given) ?? []);
      if (others.length > 0) this.beside.set(found, new Set([...this.besideOf(found), ...others]));
      this.walk(file, { file: { given: found, path: file.source.path }, up: undefined, key: '' });
    }
  }

  setKeepable(given: Given, keepable: boolean): void {
    if (keepable) this.unkeepable.delete(given);
    else this.unkeepable.add(given);
  }

  /** The opened files that this one was read with. */
  besideOf(given: Given): Iterable<Given> {
    this.settle();
    return this.beside.get(given) ?? [];
  }

  private isUnkeepable(given: Given): boolean {
    if (this.unkeepable.has(given)) return true;
    for (const other of this.besideOf(given)) if (this.unkeepable.has(other)) return true;
    return false;
  }

  /** Where a value came from: its file, and the path of keys in it. */
  find(value: object): { readonly file: OriginFile; readonly path: readonly PathKey[] } | undefined {
    this.settle();
    const origin = this.known.get(value);
    if (!origin || this.isUnkeepable(origin.file.given)) return undefined;
    const path: PathKey[] = [];
    for (let at: Origin | undefined = origin; at?.up; at = at.up) path.unshift(at.key);
    return { file: origin.file, path };
  }

  private walk(value: object, origin: Origin): void {
    // A value shared by two files belongs to the first.
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

/** The opened file that a file was read from; undefined if that is ambiguous. */
export function givenOf({ source }: ParsedFile, given: readonly Given[]): Given | undefined {
  return givenAt(source.path, given);
}

function givenAt(path: string, given: readonly Given[]): Given | undefined {
  const fitting = given.filter((g) => g.given.path === path || path.startsWith(`${g.given.path}/`));
  return fitting.length === 1 ? fitting[0] : undefined;
}
