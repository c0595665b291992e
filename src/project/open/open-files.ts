/**
 * Opening files: turns files that were read into new characters or parts of existing ones. Used by both page and
 * command, so `marrow info` reports what dropping the same files would.
 *
 * A file that has errors or does not fit holds back only what depends on it: a skeleton its skins, morphs and takes, a
 * skin its morphs. These wait for it; the rest of the character is opened without them. A skeleton that does not fit
 * what its character had before leaves that as it was.
 */

import { cutName } from '../../edit/cut-name.ts';
import { withMarkers } from '../../edit/markers.ts';
import { newCharacter } from '../../edit/new-character.ts';
import { sameJoints } from '../../edit/pose/same-joints.ts';
import { withSourcePairs } from '../../edit/rig/by-joint.ts';
import { checkSkin } from '../../evaluate/binding.ts';
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, type Document, EMPTY_DOCUMENT, findCharacter, type UnusedFile } from '../../model/document.ts';
import {
  type BrokenFile,
  byFileName,
  byPath,
  type ContentOf,
  type FileContent,
  type FileKind,
  type FileNaming,
  type ParsedFile,
  type SourceFile,
  stemOf,
  type WholeCharacter,
} from '../../model/files.ts';
import { firstTake } from '../../model/moving.ts';
import { skeletonKey } from '../../model/skeleton-key.ts';
import type { FileSpace, Space } from '../../model/space.ts';
import { tellingNames } from '../../model/telling-names.ts';
import { openingOf, type PartOpening } from '../kinds.ts';
import { checkParts, withSource, withTakesOf, withTextures, withUnread, withWhole } from './assemble.ts';
import {
  ByStem,
  type FileGroup,
  groupFiles,
  isBroken,
  isRead,
  type LooseRole,
  namesFile,
  prefixFit,
} from './grouping.ts';
import { bySkinName, isSameFile, takeCalled } from './matching.ts';
import { OpenCharacters } from './open-characters.ts';
import { fittingCharacter, givePoses, type PoseFile } from './poses.ts';
import { nameTakesApart } from './take-names.ts';

/** A file with numbers of another program. */
export type DumpFile = Extract<ParsedFile, { readonly kind: 'dump' }>;

export interface OpenResult {
  /** The same object if nothing was opened. */
  readonly document: Document;
  readonly diagnostics: readonly Diagnostic[];
  /** Ids of new or changed characters. */
  readonly opened: readonly string[];
  /** Numbers to compare with a character, which the caller chooses; the document has none of them. */
  readonly dumps: readonly DumpFile[];
  /** Label of the undo entry: "Open wasp.skel and 2 more". */
  readonly label: string;
}

/**
 * @param files in the order that decides between alternatives: as given on a command line, by name for a drop
 * @param broken files given with them that have errors
 * @param selectedId the character that receives a single skin, morph or anim
 * @param called how messages name files
 */
export function openFiles(
  document: Document,
  files: readonly ParsedFile[],
  broken: readonly BrokenFile[] = [],
  selectedId?: string,
  called = byFileName,
): OpenResult {
  return runToEnd(openInSteps(document, files, broken, selectedId, called));
}

/** `openFiles` in steps, one for each file of a character: there may be thousands. */
export function openInSteps(
  document: Document,
  files: readonly ParsedFile[],
  broken: readonly BrokenFile[] = [],
  selectedId?: string,
  called = byFileName,
): Steps<OpenResult> {
  return new Opening(document, files, broken, selectedId, called).steps();
}

/** One opening in progress. */
class Opening {
  /**
   * The document without the opening example, which is replaced and never extended; it is kept only when nothing but
   * poses is opened.
   */
  private readonly base: Document;
  /** Files left unused earlier; these files may make them usable. */
  private readonly waiting: readonly UnusedFile[];
  private readonly textures: readonly ParsedFile[];
  private readonly characters: OpenCharacters;
  /** Of before, without a skeleton; some may have one by now. */
  private readonly bare: readonly Character[];
  /** Of characters from before, by skeleton. */
  private readonly spaces = new Map<string, Space>();
  private made: number;
  private readonly diagnostics: Diagnostic[] = [];
  private readonly opened = new Set<string>();
  private readonly used = new Set<ParsedFile>();
  private readonly unused: UnusedFile[] = [];
  private readonly dumps: DumpFile[] = [];
  /** Of the figures in these files whose space was guessed, by skeleton. */
  private readonly surest = new Map<string, FileSpace>();

  constructor(
    private readonly document: Document,
    private readonly files: readonly ParsedFile[],
    private readonly broken: readonly BrokenFile[],
    private readonly selectedId: string | undefined,
    private readonly called: FileNaming,
  ) {
    const { unused, charactersMade, review } = document;
    const makesWay = document.isOpeningSample && !isForCharacters([...files, ...broken]);
    this.base = makesWay ? { ...EMPTY_DOCUMENT, unused, charactersMade, ...(review && { review }) } : document;
    this.characters = new OpenCharacters(this.base.characters);
    this.bare = this.base.characters.filter(({ skeleton }) => !skeleton);
    for (const { space, skeleton } of this.base.characters) {
      const key = space && skeleton && skeletonKey(skeleton);
      if (space && key !== undefined && !this.spaces.has(key)) this.spaces.set(key, space);
    }
    this.made = charactersMade;
    const given = new Set(files.map(({ source }) => source.path));
    this.waiting = unused.filter(({ file }) => !given.has(file.source.path));
    this.textures = [...files, ...this.waiting.map((w) => w.file)].filter((f) => f.kind === 'texture');
  }

  *steps(): Steps<OpenResult> {
    const { files, broken, called } = this;
    const wanted = this.waiting.filter((waiting) => this.isCalledFor(waiting)).map(({ file }) => file);
    const grouping = groupFiles([...files, ...broken.map((b) => ({ ...b, broken: true as const })), ...wanted], called);
    this.diagnostics.push(...grouping.diagnostics);
    for (const file of files) {
      for (const { skeleton, space } of charactersIn(file)) {
        const key = skeletonKey(skeleton);
        if (space?.space.known === 'guessed' && !(space.standing <= (this.surest.get(key)?.standing ?? -1)))
          this.surest.set(key, space);
      }
    }
    for (const group of grouping.groups) yield* this.openGroup(group);
    this.adoptTakes();
    const openLoose: { readonly [R in LooseRole]: (loose: readonly ParsedFile[]) => void } = {
      part: (loose) => {
        // Morphs last: the skin they modify may be among the files and come later.
        for (const file of loose) if (!needsCharacter(file)) this.openLoose(file);
        for (const file of loose) if (needsCharacter(file)) this.openLoose(file);
        // Markers are matched by the names of takes.
        this.nameApart();
      },
      // After all characters, each of which they can apply to.
      poses: (loose) => {
        for (const file of loose) if (file.kind === 'pose') this.openPoses(file);
      },
      markers: (loose) => {
        for (const file of loose) if (file.kind === 'markers') this.openMarkers(file);
      },
      // Given to skins at the end, together with those that were waiting.
      texture: () => undefined,
      dump: (loose) => {
        for (const file of loose) if (file.kind === 'dump') this.dumps.push(file);
      },
    };
    // In this order. Its keys are the roles, which TypeScript types as strings.
    for (const role of Object.keys(openLoose) as LooseRole[]) openLoose[role](grouping.loose[role].filter(isRead));
    for (const rig of grouping.idleRigs.filter(isRead)) {
      this.unused.push({ file: rig, why: 'None of the files it names was opened.' });
    }
    this.takeUpWaiting();
    this.dressAll();
    return this.result();
  }

  private result(): OpenResult {
    const { document, files, opened, used, characters } = this;
    const unused = sameFiles(this.unused, document.unused) ? document.unused : this.unused;
    const given = new Set(files);
    for (const { file, why, waitsFor } of unused) {
      if (!given.has(file)) continue;
      const [code, message, assumed] = waitsFor
        ? ['held-back', `Not opened. ${why}`, 'kept until that is mended']
        : ['file-unused', `Not used: ${why}`, 'kept for a matching file'];
      this.diagnostics.push(withoutPlace('info', code, message, this.called(file.source), assumed));
    }
    const changed = files.filter((f) => used.has(f) || f.kind === 'texture');
    const rest = {
      diagnostics: this.diagnostics,
      opened: [...opened],
      dumps: this.dumps,
      label: openLabel(changed.length ? changed : files),
    };
    if (opened.size === 0) {
      // If nothing was opened, the opening example stays.
      return { ...rest, document: unused === document.unused ? document : { ...document, unused } };
    }
    const next = { characters: characters.all, unused, charactersMade: this.made, isOpeningSample: false };
    return { ...rest, document: { ...this.base, ...next } };
  }

  /** Whether one of the files names this waiting one, is named by it, or is the one that it waits for. */
  private isCalledFor({ file, waitsFor }: UnusedFile): boolean {
    return this.files.some(
      (f) =>
        namesFile(f, file.source) ||
        namesFile(file, f.source) ||
        (waitsFor !== undefined && isSameFile(waitsFor, f.source)),
    );
  }

  private *openGroup(group: FileGroup): Steps<void> {
    const { skeleton, rigs, parts } = group;
    const broken = parts.filter(isBroken);
    const rest = [...rigs, ...parts].filter(isRead);
    const skeletonFile = skeleton && isRead(skeleton) ? skeleton : undefined;
    // The skeleton, or all that a rig names.
    const missing = skeletonFile ? undefined : (skeleton ?? (rest.length === rigs.length ? broken[0] : undefined));
    if (missing) {
      for (const file of rest) this.wait(file, missing.source);
      return;
    }
    const files = [...rigs, ...(skeleton ? [skeleton] : []), ...parts].filter(isRead);
    const wholes = skeletonFile ? charactersIn(skeletonFile) : [undefined];
    const earlier = skeletonFile ? this.characters.withFile(skeletonFile.source) : [];
    for (const [root, whole] of wholes.entries()) {
      const before = earlier[root] ?? (whole && root === 0 ? this.withoutSkeletonFor(group, whole) : undefined);
      const name = group.name ?? whole?.skeleton.name ?? stemOf(files[0].source);
      const own = skeletonFile && whole ? { file: skeletonFile, whole } : undefined;
      // Several roots become several characters; the other files of the group belong to the first.
      if (root === 0) yield* this.assemble({ name, own, files, broken }, before);
      else yield* this.assemble({ name, own, files: skeletonFile ? [skeletonFile] : [], broken: [] }, before);
    }
    // The file has fewer roots than before.
    const gone = new Set(earlier.slice(wholes.length));
    if (gone.size) this.characters.replaceAll(this.characters.all.filter((c) => !gone.has(c)));
  }

  /** Opens a character with those of its files that fit. */
  private *assemble({ name, own, files, broken }: CharacterFiles, before: Character | undefined): Steps<void> {
    const start = before ?? this.make(name);
    const unread: BrokenFile[] = [...broken];
    let left = files;
    for (;;) {
      const skin = unread.find(({ kind }) => kind === 'skin');
      const skins = [before, own?.whole].flatMap((from) => from?.skins ?? []);
      if (skin && skins.length === 0 && !left.some(({ kind }) => kind === 'skin')) {
        const waiting = left.filter((file) => partOpening(file)?.onSkin);
        for (const file of waiting) this.wait(file, skin.source);
        unread.push(...waiting);
        left = left.filter((file) => !waiting.includes(file));
      }
      // One that waited for a skeleton was named after its take or skin.
      const called = start.skeleton ? start : { ...start, name };
      const next = yield* this.assembled(called, left, own, before);
      const misfits = this.settle(
        before,
        withUnread(
          next,
          unread.map(({ source }) => source),
        ),
        left,
      );
      if (misfits.length === 0) break;
      unread.push(...misfits);
      left = left.filter((file) => !misfits.includes(file));
    }
    for (const { source } of this.opened.has(start.id) ? broken : []) {
      this.told('info', 'opened-without', `"${start.skeleton ? start.name : name}" is opened without it.`, source);
    }
  }

  private *assembled(
    start: Character,
    files: readonly ParsedFile[],
    own: CharacterFiles['own'],
    before: Character | undefined,
  ): Steps<Character> {
    let next = start;
    if (own) {
      const { file, whole } = own;
      next = withWhole(next, whole, { ...file, before }, before?.space ?? this.spaceOf(whole));
    }
    for (const file of files) {
      next = withFile(next, file, before);
      yield Math.min(1, this.used.size / this.files.length);
    }
    // Of several new alternatives, show the first.
    return before ? next : { ...next, shownSkin: 0, shownClip: firstTake(next.clips) };
  }

  /** Takes that were opened without a skeleton go to the one that they are named after, or to the only one. */
  private adoptTakes(): void {
    const waiting = this.bare.filter(({ id, skins, clips }) => !this.opened.has(id) && !skins.length && clips.length);
    if (waiting.length === 0) return;
    const fresh = new ByStem<Character>();
    for (const character of this.characters.all) {
      const file = character.parts?.skeleton?.file;
      if (file && this.opened.has(character.id)) fresh.add(character, file.source);
    }
    const isOnly = this.characters.all.filter(({ skeleton }) => skeleton).length === 1;
    const adopted = new Set<string>();
    for (const take of waiting) {
      const found = take.sources.flatMap((source) => fresh.named(source) ?? [])[0] ?? (isOnly ? fresh.only : undefined);
      const target = found && this.characters.current(found);
      if (!target) continue;
      this.characters.replace(withTakesOf(target, take));
      adopted.add(take.id);
    }
    if (adopted.size) this.characters.replaceAll(this.characters.all.filter(({ id }) => !adopted.has(id)));
  }

  /** Tells new characters, and takes of whole characters, from others of the same name. */
  private nameApart(): void {
    const { characters, base, opened } = this;
    const fresh = characters.all.filter((c) => opened.has(c.id) && !findCharacter(base, c.id) && c.sources.length > 0);
    const names = tellingNames(
      fresh.map(({ name, sources: [input] }) => ({ name, input, isOnly: true })),
      base.characters.map(({ name }) => name),
    );
    for (const [i, character] of fresh.entries()) {
      if (names[i] !== character.name) characters.replace({ ...character, name: names[i] });
    }
    nameTakesApart(characters, base, opened);
  }

  /**
   * Motion capture does not say how its space is oriented, scaled and grounded. Takes of one skeleton share what is
   * known of one that is open already, or else the guess for the one that stands most. What a file states counts, unless
   * the user has set another space for that skeleton.
   */
  private spaceOf({ skeleton, space }: WholeCharacter): Space | undefined {
    if (!space) return undefined;
    const key = skeletonKey(skeleton);
    const open = this.spaces.get(key);
    if (space.space.known === 'stated') return open && open.known === undefined ? open : space.space;
    return open ?? (this.surest.get(key) ?? space).space;
  }

  /** A skin, morph or anim without a skeleton among the files. */
  private openLoose(file: ParsedFile): void {
    const { base } = this;
    const characters = this.characters.all;
    const { onSkin, unused } = partOpening(file) ?? {};
    const fitting = onSkin ? characters.filter((c) => c.skins.length > 0) : characters;
    // Only characters from before can have been selected.
    const meant =
      findCharacter(base, this.selectedId) ?? (base.characters.length === 1 ? base.characters[0] : undefined);
    const target =
      this.characters.withFile(file.source)[0] ??
      (onSkin ? bySkinName(file.source, characters) : undefined) ??
      (meant && this.characters.current(meant)) ??
      (unused !== undefined && fitting.length === 1 ? fitting[0] : undefined);
    if (target && fitting.includes(target)) this.settle(target, withFile(target, file, target), [file]);
    else if (unused !== undefined) this.unused.push({ file, why: unused });
    // Shown by itself; it waits for a skeleton.
    else this.settle(undefined, withFile(this.make(stemOf(file.source)), file, undefined), [file]);
  }

  /** Adds poses to the library of a character with matching joints. */
  private openPoses(file: PoseFile): void {
    const characters = this.characters.all;
    const fresh = characters.filter((c) => this.opened.has(c.id));
    const selected = findCharacter(this.base, this.selectedId);
    const meant = selected && this.characters.current(selected);
    const known = this.characters.withFile(file.source);
    const target = fittingCharacter(file, [...known, ...(meant ? [meant] : []), ...fresh, ...characters]);
    if (!target) {
      this.unused.push({ file, why: 'No open character has the joints of its poses.' });
      return;
    }
    const { character, diagnostics } = givePoses(target, file, this.called);
    this.diagnostics.push(...diagnostics);
    this.characters.replace(character);
    this.opened.add(target.id);
    this.used.add(file);
  }

  /** Gives markers to the take that they are called after: one from the same folder, just opened, or any. */
  private openMarkers(file: ContentOf<'markers'> & { readonly source: SourceFile }): void {
    const characters = this.characters.all;
    const found = takeCalled(file.source, [...characters.filter((c) => this.opened.has(c.id)), ...characters]);
    if (!found) {
      this.unused.push({ file, why: 'No open take has the name of these markers.' });
      return;
    }
    const { character, clip } = found;
    const clips = character.clips.with(clip, withMarkers(character.clips[clip], file.markers));
    this.characters.replace({ ...character, clips });
    this.opened.add(character.id);
    this.used.add(file);
  }

  /** Gives waiting files to characters that were just opened, matched by name; the others keep waiting. */
  private takeUpWaiting(): void {
    for (const waiting of this.waiting) {
      const { file } = waiting;
      if (this.used.has(file) || file.kind === 'texture' || this.unused.some((u) => u.file === file)) continue;
      if (file.kind === 'pose') {
        this.openPoses(file);
        continue;
      }
      if (file.kind === 'markers') {
        this.openMarkers(file);
        continue;
      }
      const fresh = this.characters.all.filter((c) => this.opened.has(c.id));
      const target = partOpening(file)?.onSkin ? bySkinName(file.source, fresh) : undefined;
      const next = target && withFile(target, file, target);
      if (target && next && !hasErrors(checkParts(target, next, this.called))) this.settle(target, next, [file]);
      else this.unused.push(waiting);
    }
  }

  /** Gives textures that came alone to the skins that name them. */
  private dressAll(): void {
    for (const character of [...this.characters.all]) {
      const dressed = withTextures(character, this.textures);
      if (dressed === character) continue;
      this.characters.replace(dressed);
      this.opened.add(character.id);
    }
    const shown = this.characters.all.flatMap((c) => c.textures);
    for (const file of this.textures) {
      if (file.kind !== 'texture' || shown.includes(file.texture)) continue;
      this.unused.push({ file, why: 'No open skin names it as its texture.' });
    }
  }

  /**
   * Adds the finished character, unless a part does not fit.
   *
   * @returns the files that don't fit, without which it may be tried again; empty if it was added, or can't be
   */
  private settle(before: Character | undefined, after: Character, files: readonly ParsedFile[]): readonly ParsedFile[] {
    const dressed = withTextures(after, this.textures);
    const found = checkParts(before, dressed, byPath);
    const named = new Map(dressed.sources.map((source) => [source.path, this.called(source)]));
    const errors = new Set(found.filter(({ severity }) => severity === 'error').map(({ file }) => file));
    const misfits = files.filter((file) => partOpening(file) && errors.has(file.source.path));
    const isWithout = misfits.length > 0 && misfits.length < files.length;
    const problems = isWithout ? found.filter(({ file }) => misfits.some(({ source }) => source.path === file)) : found;
    this.diagnostics.push(
      ...problems.map((problem) => ({ ...problem, file: named.get(problem.file) ?? problem.file })),
    );
    if (isWithout) return misfits;
    const [error] = errors;
    if (error !== undefined) {
      const why = `It belongs with ${named.get(error) ?? error}, which does not fit.`;
      for (const { source } of files) {
        if (source.path !== error) this.told('info', 'held-back', `Not opened. ${why}`, source);
      }
      return [];
    }
    if (before) this.characters.replace(dressed);
    else this.characters.add(dressed);
    if (before?.skeleton && dressed.skeleton && before.skeleton !== dressed.skeleton) {
      const to = sameJoints(before.skeleton, dressed.skeleton);
      this.characters.replaceAll(withSourcePairs(this.characters.all, dressed.id, before.skeleton, to));
    }
    this.opened.add(dressed.id);
    for (const file of files) this.used.add(file);
    return [];
  }

  /** @param missing has errors, or does not fit */
  private wait(file: ParsedFile, missing: SourceFile): void {
    const why = `It belongs with ${this.called(missing)}, which has errors.`;
    this.unused.push({ file, why, waitsFor: missing });
  }

  private told(severity: Diagnostic['severity'], code: string, message: string, source: SourceFile): void {
    this.diagnostics.push(withoutPlace(severity, code, message, this.called(source)));
  }

  /** Ids are never reused, so that a selection or a view can't confuse two characters. */
  private make(name: string): Character {
    return newCharacter(`c${++this.made}`, name);
  }

  /** A character without a skeleton that this group completes: matched by name, or the only one waiting. */
  private withoutSkeletonFor(group: FileGroup, { skeleton }: WholeCharacter): Character | undefined {
    const fits = ({ skins }: Character) => skins.every((skin) => !hasErrors(checkSkin(skin, skeleton, '')));
    const waiting = this.bare
      .flatMap((c) => (this.opened.has(c.id) ? [] : (this.characters.current(c) ?? [])))
      .filter(fits);
    const stem = group.skeleton ? stemOf(group.skeleton.source) : '';
    const byName = waiting.find((c) => c.sources.some((s) => prefixFit(stem, stemOf(s)) > 0));
    // A group with its own skin or animation is complete and takes no other character's.
    return byName ?? (waiting.length === 1 && group.parts.length === 0 ? waiting[0] : undefined);
  }
}

/** What a character is opened from. */
interface CharacterFiles {
  /** Of a new one. */
  readonly name: string;
  /** Its skeleton; absent for a skin that a rig names without one. */
  readonly own: { readonly file: ParsedFile; readonly whole: WholeCharacter } | undefined;
  /** Rigs, skeleton and parts. */
  readonly files: readonly ParsedFile[];
  /** Parts with errors. */
  readonly broken: readonly BrokenFile[];
}

/** Whether the files are poses or dumps only, which show nothing by themselves. */
function isForCharacters(files: readonly { readonly kind: FileKind }[]): boolean {
  return files.length > 0 && files.every(({ kind }) => kind === 'pose' || kind === 'dump' || kind === 'markers');
}

function charactersIn(file: ParsedFile): readonly WholeCharacter[] {
  const opening = openingOf(file.kind);
  return opening.as === 'characters' ? opening.characters(file) : [];
}

function partOpening({ kind }: ParsedFile): PartOpening<FileContent> | undefined {
  const opening = openingOf(kind);
  return opening.as === 'part' ? opening : undefined;
}

/** Whether a file is of no use without a character that it belongs to. */
function needsCharacter(file: ParsedFile): boolean {
  return partOpening(file)?.unused !== undefined;
}

/** Adds a file of a group: its content, if it is a part. */
function withFile(character: Character, file: ParsedFile, before: Character | undefined): Character {
  let next = character;
  for (const source of [...(file.beside ?? []), file.source]) next = withSource(next, source, before);
  return partOpening(file)?.add(next, file, { ...file, before }) ?? next;
}

function sameFiles(a: readonly UnusedFile[], b: readonly UnusedFile[]): boolean {
  return a.length === b.length && a.every((u, i) => u.file === b[i].file);
}

/** Characters of a file's name in the undo step. */
const FILE_LENGTH = 40;

function openLabel(files: readonly ParsedFile[]): string {
  const first = cutName(files[0]?.source.name ?? 'files', FILE_LENGTH);
  return files.length > 1 ? `Open ${first} and ${files.length - 1} more` : `Open ${first}`;
}
