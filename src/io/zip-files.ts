/** Several files as one zip, by fflate. */
import { strToU8, type Zippable, zipSync } from 'fflate';

export interface ZippedFile {
  /** Duplicates are renamed: the second becomes `walk (2).anim`. */
  readonly name: string;
  readonly content: string | Uint8Array;
}

/** Puts everything in a folder of that name, so that it unpacks beside other characters. */
export function zipFiles(folder: string, files: readonly ZippedFile[]): Uint8Array<ArrayBuffer> {
  const entries: Zippable = {};
  for (const { name, content } of files) {
    const bytes = typeof content === 'string' ? strToU8(content) : content;
    // Images are already compressed.
    entries[`${folder}/${freeName(name, folder, entries)}`] = [bytes, { level: typeof content === 'string' ? 6 : 0 }];
  }
  return new Uint8Array(zipSync(entries));
}

function freeName(name: string, folder: string, taken: Zippable): string {
  const dot = name.lastIndexOf('.');
  for (let n = 1; ; n++) {
    const free = n === 1 ? name : `${name.slice(0, dot)} (${n})${name.slice(dot)}`;
    if (!(`${folder}/${free}` in taken)) return free;
  }
}
