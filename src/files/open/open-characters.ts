/** The characters of an opening in progress: found by their files, placed and replaced without a look at all others. */
import { Placing } from '../../edit/place-beside.ts';
import type { Character } from '../../model/document.ts';
import { folderOf, type SourceFile } from '../../model/files.ts';
import { hasSource } from './matching.ts';

/** The characters of an opening, in the document's order, with indices by id and by file. */
export class OpenCharacters {
  private list: Character[];
  /** Indices by id. */
  private readonly at = new Map<string, number>();
  /** Ids by the name of a file in lower case, alone and after its folder; some may have lost that file since. */
  private readonly byFile = new Map<string, Set<string>>();
  /** Absent: what was placed has changed since. */
  private placing: Placing | undefined;

  constructor(characters: readonly Character[]) {
    this.list = [...characters];
    this.index();
  }

  /** Changes with what is added, replaced and removed. */
  get all(): readonly Character[] {
    return this.list;
  }

  /** The character of this id as it is now. */
  current({ id }: Character): Character | undefined {
    const at = this.at.get(id);
    return at === undefined ? undefined : this.list[at];
  }

  /** Those that have a file of this name from the same folder, in order; a file without a folder matches any. */
  withFile(source: SourceFile): readonly Character[] {
    const name = source.name.toLowerCase();
    const folder = folderOf(source);
    const keys = folder ? [`/${name}`, `${folder}/${name}`] : [name];
    const ids = new Set(keys.flatMap((key) => [...(this.byFile.get(key) ?? [])]));
    const found = [...ids].flatMap((id) => this.at.get(id) ?? []).sort((a, b) => a - b);
    return found.map((at) => this.list[at]).filter((character) => hasSource(character, source));
  }

  /** Adds one beside all others. @returns it as placed */
  add(character: Character): Character {
    this.placing ??= new Placing(this.list);
    const placed = { ...character, placements: [this.placing.place(character)] };
    this.placing.add(placed);
    this.at.set(placed.id, this.list.push(placed) - 1);
    this.indexFiles(placed);
    return placed;
  }

  /** By its id. */
  replace(character: Character): void {
    const at = this.at.get(character.id);
    if (at === undefined) return;
    this.list[at] = character;
    this.indexFiles(character);
    this.placing = undefined;
  }

  /** All at once, in the same order; some may be the same. */
  replaceAll(characters: readonly Character[]): void {
    if (characters === this.list) return;
    this.list = [...characters];
    this.index();
  }

  private index(): void {
    this.placing = undefined;
    this.at.clear();
    this.byFile.clear();
    for (const [i, character] of this.list.entries()) {
      this.at.set(character.id, i);
      this.indexFiles(character);
    }
  }

  private indexFiles({ id, sources, unread = [] }: Character): void {
    for (const source of [...sources, ...unread]) {
      const name = source.name.toLowerCase();
      for (const key of [name, `${folderOf(source)}/${name}`]) {
        const ids = this.byFile.get(key);
        if (ids) ids.add(id);
        else this.byFile.set(key, new Set([id]));
      }
    }
  }
}
