/**
 * Which values of the document come from which opened file. The document shares everything unedited with what was read,
 * by identity; so a value found here need not be stored: the file and the path to it are enough.
 *
 * Parts of a file are known at every depth: after one joint's limits are edited, all other joints are still the file's.
 */
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import type { KeptFile } from '../../io/session-store.ts';
import type { ParsedFile } from '../../model/files.ts';
import { trackedOf } from '../../model/takes/tracked-take.ts';
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

interface Learned {
  readonly givenAt: (path: string) => Given | undefined;
  readonly files: readonly ParsedFile[];
  /** Index of the file that is looked through next. */
  next: number;
}

export class Origins {
  /** Weak: doesn't keep unused parts of files alive. */
  private readonly known = new WeakMap<object, Origin>();
  /** Opened files whose Blobs can't be stored: everything from them is kept as if created here. */
  private readonly unkeepable = new WeakSet<Given>();
  /** What an opened file can't be read without, such as the buffers of a `.gltf`. */
  private readonly beside = new WeakMap<Given, ReadonlySet<Given>>();

  /** Takes whose channels are yet to be made. */
  private readonly tracked = new Set<WeakRef<object>>();

  /** Learned, and looked through up to some file. */
  private readonly learned: Learned[] = [];

  /** @param nextId first id for opened files: above the ids of all that may be adopted */
  constructor(private nextId = 1) {}

  /** Registers opened files. They are looked through with the next save: of thousands that takes a while. */
  learn(given: readonly GivenBlob[], files: readonly ParsedFile[]): void {
    const opening = this.nextId;
    // The path on disk and the like aren't needed to read the file again.
    const all = given.map(({ path, blob }): Given => ({ id: this.nextId++, opening, given: { path, blob } }));
    this.adopt(all, files);
  }

  /** Registers files that were kept and have ids already. */
  adopt(given: readonly Given[], files: readonly ParsedFile[]): void {
    this.learned.push({ givenAt: givenIn(given), files, next: 0 });
  }

  /** Looks through what was learned, a file a step; whoever asks for a value doesn't wait for the steps. */
  *look(): Steps<void> {
    for (let [first] = this.learned; first; [first] = this.learned) {
      while (first.next < first.files.length) {
        this.register(first.files[first.next++], first.givenAt);
        yield 0;
      }
      if (this.learned[0] === first) this.learned.shift();
    }
    this.lookAtTakes();
  }

  private settle(): void {
    // Asked for each value that is stored.
    if (this.learned.length > 0) runToEnd(this.look());
  }

  private register(file: ParsedFile, givenAt: Learned['givenAt']): void {
    const found = givenAt(file.source.path);
    if (!found || file.isJoinedByChoice) return;
    const others = (file.beside ?? []).flatMap(({ path }) => givenAt(path) ?? []);
    if (others.length > 0) this.beside.set(found, new Set([...(this.beside.get(found) ?? []), ...others]));
    this.walk(file, { file: { given: found, path: file.source.path }, up: undefined, key: '' });
  }

  /** Looks through takes whose channels have been made since. */
  private lookAtTakes(): void {
    for (const one of this.tracked) {
      const take = one.deref();
      if (take && trackedOf(take)) continue;
      this.tracked.delete(one);
      const origin = take && this.known.get(take);
      if (origin) this.walkInside(take, origin);
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
    if (trackedOf(value)) this.tracked.add(new WeakRef(value));
    else this.walkInside(value, origin);
  }

  private walkInside(value: object, origin: Origin): void {
    const step = (key: PathKey, inner: unknown) => {
      if (typeof inner === 'object' && inner !== null) this.walk(inner, { file: origin.file, up: origin, key });
    };
    if (Array.isArray(value)) for (const [index, inner] of value.entries()) step(index, inner);
    else for (const [key, inner] of Object.entries(value)) step(key, inner);
  }
}

/** Finds the opened file that the file of a path was read from, itself or a zip; undefined if that is ambiguous. */
export function givenIn(given: readonly Given[]): (path: string) => Given | undefined {
  const byPath = new Map<string, Given | 'several'>();
  for (const one of given) byPath.set(one.given.path, byPath.has(one.given.path) ? 'several' : one);
  return (path) => {
    let found: Given | undefined;
    for (let end = path.length; end > 0; end = path.lastIndexOf('/', end - 1)) {
      const one = byPath.get(path.slice(0, end));
      if (one === 'several' || (one && found)) return undefined;
      found ??= one;
    }
    return found;
  };
}
