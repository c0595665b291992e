/**
 * Opening files: what was read becomes characters, or parts of characters that are there. Page and command line both
 * go through here, so what `marrow info` says of files given together is what a drop would say.
 *
 * All or nothing for each character: where one of the files that belong together has an error, or does not fit, none
 * of them is opened and everything stays as it was. Other characters of the same drop are not held up.
 */
import { checkClip, checkMorph, checkSkin } from '../evaluate/binding.ts';
import { type Diagnostic, hasErrors } from '../model/diagnostic.ts';
import {
  type Character,
  DEFAULT_PLACEMENT,
  type Document,
  EMPTY_DOCUMENT,
  findCharacter,
  shownClip,
  shownSkin,
  type UnusedFile,
} from '../model/document.ts';
import { filePose, jointDofCount } from '../model/dofs.ts';
import { type BrokenFile, folderOf, type ParsedFile, type SourceFile, sameName, stemOf } from '../model/files.ts';
import type { Skeleton } from '../model/skeleton.ts';
import { withoutUnkeyed } from './commands/pose.ts';
import { baseName, type FileGroup, type GivenFile, groupFiles, isBroken, isRead, prefixFit } from './grouping.ts';
import { placeBeside } from './place-beside.ts';

export interface OpenResult {
  /** The very same document where nothing was opened. */
  readonly document: Document;
  readonly diagnostics: readonly Diagnostic[];
  /** Ids of the characters that are new or changed. */
  readonly opened: readonly string[];
  /** For the undo entry: "Open wasp.skel and 2 more". */
  readonly label: string;
}

/**
 * @param files in the order that decides between alternatives: as given on a command line, by name for a drop
 * @param broken files that were given too, but have errors
 * @param selectedId the character that a lone skin, morph or anim goes to
 */
export function openFiles(
  document: Document,
  files: readonly ParsedFile[],
  broken: readonly BrokenFile[] = [],
  selectedId?: string,
): OpenResult {
  // The opening sample makes way, and nothing attaches to it.
  const base = document.isOpeningSample ? EMPTY_DOCUMENT : document;
  // What lay unused may be what these files were missing.
  const waiting = base.unused.map((u) => u.file).filter((old) => !files.some((f) => f.source.path === old.source.path));
  const given: GivenFile[] = [...files, ...broken.map((b) => ({ ...b, broken: true as const })), ...waiting];
  const grouping = groupFiles(given);
  const textures = grouping.textures.filter(isRead);
  const diagnostics = [...grouping.diagnostics];
  const opened = new Set<string>();
  const used = new Set<ParsedFile>();
  const unused: UnusedFile[] = [];
  let characters: readonly Character[] = base.characters;

  /** Puts a finished character in, unless something does not fit. */
  const settle = (before: Character | undefined, after: Character, parts: readonly ParsedFile[]) => {
    const dressed = withTextures(after, textures);
    const problems = check(before, dressed);
    diagnostics.push(...problems);
    if (hasErrors(problems)) return;
    const next = before ? dressed : { ...dressed, placements: [placeBeside(characters, dressed)] };
    characters = before ? characters.map((c) => (c === before ? next : c)) : [...characters, next];
    opened.add(next.id);
    for (const part of parts) used.add(part);
  };

  for (const group of grouping.groups) {
    const members = [...group.rigs, ...(group.skeleton ? [group.skeleton] : []), ...group.parts];
    const holes = members.filter(isBroken);
    if (holes.length) {
      diagnostics.push(...heldBack(members, holes));
      for (const member of members.filter(isRead)) used.add(member);
      continue;
    }
    const parts = members.filter(isRead);
    const skeletonFile = parts.find((p) => p.kind === 'skel');
    const skeletons = skeletonFile?.kind === 'skel' ? skeletonFile.skeletons : [undefined];
    const earlier = skeletonFile ? characters.filter((c) => hasSource(c, skeletonFile.source)) : [];
    skeletons.forEach((skeleton, root) => {
      const before = earlier[root] ?? (skeletonFile && root === 0 ? waitingFor(characters, group, opened) : undefined);
      // Several roots are several characters; what else is in the group belongs to the first.
      const own = root === 0 ? parts : parts.filter((p) => p.kind === 'skel');
      let next =
        before ??
        newCharacter(
          nextId([...document.characters, ...characters]),
          group.name ?? skeleton?.name ?? stemOf(parts[0].source),
        );
      if (skeleton) next = withSkeleton(next, skeleton);
      for (const part of own) next = withPart(next, part);
      settle(before, { ...next, ...(before ? {} : { shownSkin: 0, shownClip: next.clips.length ? 0 : -1 }) }, own);
    });
    // A file that now has fewer roots than it had.
    const gone = new Set(earlier.slice(skeletons.length));
    if (gone.size) characters = characters.filter((c) => !gone.has(c));
  }

  // Morphs last: the skin that they change may be among the files, and stand after them.
  const loose = [...grouping.loose].sort((a, b) => Number(a.kind === 'morph') - Number(b.kind === 'morph'));
  for (const file of loose) {
    if (isBroken(file)) continue;
    const target =
      characters.find((c) => hasSource(c, file.source)) ??
      (file.kind === 'morph' ? withSkinFor(file.source, characters) : undefined) ??
      findCharacter({ ...base, characters }, selectedId) ??
      (base.characters.length === 1 ? characters.find((c) => c.id === base.characters[0].id) : undefined) ??
      (file.kind === 'morph' ? onlySkinned(characters) : undefined);
    if (target && (file.kind !== 'morph' || target.skins.length)) settle(target, withPart(target, file), [file]);
    else if (file.kind === 'skin' || file.kind === 'anim') {
      // Alone it is shown as it is, and waits for a skeleton.
      settle(
        undefined,
        withPart(newCharacter(nextId([...document.characters, ...characters]), stemOf(file.source)), file),
        [file],
      );
    } else unused.push({ file, why: 'There is no skin here that it could change.' });
  }

  // Textures that came alone go to the skins that name them.
  for (const character of characters) {
    const dressed = withTextures(character, textures);
    if (dressed === character) continue;
    characters = characters.map((c) => (c === character ? dressed : c));
    opened.add(character.id);
  }
  const names = characters.flatMap((c) => c.textures);
  for (const file of textures) {
    if (file.kind !== 'texture') continue;
    if (!names.includes(file.texture)) unused.push({ file, why: 'No skin here names it as its texture.' });
  }
  for (const file of grouping.idleRigs) {
    if (!isBroken(file)) unused.push({ file, why: 'None of the files that it names was given.' });
  }

  if (opened.size === 0) {
    // What opens nothing does not drive the opening sample away either.
    const same = unused.length === document.unused.length;
    return { document: same ? document : { ...document, unused }, diagnostics, opened: [], label: openLabel(files) };
  }
  const changed = files.filter((f) => used.has(f) || f.kind === 'texture');
  return {
    document: { characters, unused, isOpeningSample: false },
    diagnostics,
    opened: [...opened],
    label: openLabel(changed.length ? changed : files),
  };
}

/** The character of the skin whose name is the longest beginning of a morph's: `head1.morph` → `head.skin`. */
function withSkinFor(source: SourceFile, characters: readonly Character[]): Character | undefined {
  let best: Character | undefined;
  let length = 0;
  for (const character of characters) {
    for (const { name } of character.skins) {
      const fit = prefixFit(name, stemOf(source));
      if (fit <= length) continue;
      best = character;
      length = fit;
    }
  }
  return best;
}

/** The character that a morph without any other hint is for. */
function onlySkinned(characters: readonly Character[]): Character | undefined {
  const skinned = characters.filter((c) => c.skins.length > 0);
  return skinned.length === 1 ? skinned[0] : undefined;
}

function newCharacter(id: string, name: string): Character {
  return {
    id,
    name,
    skins: [],
    shownSkin: 0,
    morphs: [],
    textures: [],
    clips: [],
    shownClip: -1,
    pose: filePose(undefined, 0),
    clampsToLimits: true,
    placements: [DEFAULT_PLACEMENT],
    timeOffsetSeconds: 0,
    sources: [],
  };
}

/**
 * Ids are counted up, so that opening the same files in the same document gives the same again. The opening sample's
 * counts too: what takes its place is another character.
 */
function nextId(characters: readonly Character[]): string {
  let next = 1;
  for (const { id } of characters) next = Math.max(next, Number(id.slice(1)) + 1);
  return `c${next}`;
}

/** The new skeleton's own pose; root translation and morph weights stay. */
function withSkeleton(character: Character, skeleton: Skeleton): Character {
  const weights = character.morphs.length ? character.pose.slice(-character.morphs.length) : [];
  const joints = filePose(skeleton, 0).slice(3);
  return { ...withoutUnkeyed(character), skeleton, pose: [...character.pose.slice(0, 3), ...joints, ...weights] };
}

/** Adds a part, or replaces the one that came from a file of the same name; what is new is what is shown. */
function withPart(character: Character, file: ParsedFile): Character {
  const sources = [...character.sources.filter((s) => !sameName(s.name, file.source.name)), file.source];
  const next = { ...character, sources };
  switch (file.kind) {
    case 'skin': {
      const at = indexByName(next.skins, file.skin.name);
      return { ...next, skins: put(next.skins, at, file.skin), shownSkin: at < 0 ? next.skins.length : at };
    }
    case 'morph': {
      const at = indexByName(next.morphs, file.morph.name);
      return {
        ...next,
        morphs: put(next.morphs, at, file.morph),
        pose: at < 0 ? [...next.pose, 0] : next.pose,
      };
    }
    case 'anim': {
      const at = indexByName(next.clips, file.clip.name);
      return {
        ...withoutUnkeyed(next),
        clips: put(next.clips, at, file.clip),
        shownClip: at < 0 ? next.clips.length : at,
      };
    }
    case 'skel':
    case 'rig':
    case 'texture':
      return next;
  }
}

function indexByName(parts: readonly { readonly name: string }[], name: string): number {
  return parts.findIndex((p) => p.name === name);
}

function put<T>(list: readonly T[], at: number, item: T): readonly T[] {
  return at < 0 ? [...list, item] : list.map((old, i) => (i === at ? item : old));
}

/** Whether the character has a file of that name from the same place; a file given without folders is anywhere's. */
function hasSource(character: Character, source: SourceFile): boolean {
  return character.sources.some((own) => {
    if (!sameName(own.name, source.name)) return false;
    const [a, b] = [folderOf(own), folderOf(source)];
    return a === b || a === '' || b === '';
  });
}

/** A character without a skeleton that this one completes: by name, or the only one that waits. */
function waitingFor(characters: readonly Character[], group: FileGroup, opened: ReadonlySet<string>) {
  const waiting = characters.filter((c) => !c.skeleton && !opened.has(c.id));
  const stem = group.skeleton ? stemOf(group.skeleton.source) : '';
  const byName = waiting.find((c) => c.sources.some((s) => prefixFit(stem, stemOf(s)) > 0));
  // With a skin or an animation of its own the group is complete, and takes nobody else's.
  return byName ?? (waiting.length === 1 && group.parts.length === 0 ? waiting[0] : undefined);
}

/** Gives a character's skins the textures that they name; the same character where there is nothing to give. */
function withTextures(character: Character, given: readonly ParsedFile[]): Character {
  const skinFolders = character.sources.filter((s) => s.name.toLowerCase().endsWith('.skin')).map(folderOf);
  let next = character;
  for (const skin of character.skins) {
    const wanted = skin.material?.texture;
    if (wanted === undefined) continue;
    const fits = given.filter((f) => f.kind === 'texture' && sameName(f.source.name, baseName(wanted)));
    const file = fits.find((f) => skinFolders.includes(folderOf(f.source))) ?? fits[0];
    if (file?.kind !== 'texture' || next.textures.includes(file.texture)) continue;
    next = {
      ...next,
      textures: [...next.textures.filter((t) => !sameName(t.name, file.texture.name)), file.texture],
      sources: [...next.sources.filter((s) => !sameName(s.name, file.source.name)), file.source],
    };
  }
  return next;
}

/** What does not fit among a character's parts; only parts that are new, or whose counterpart is. */
function check(before: Character | undefined, after: Character): Diagnostic[] {
  const problems: Diagnostic[] = [];
  const fileOf = (name: string, ending: string) =>
    after.sources.find((s) => stemOf(s) === name && s.name.toLowerCase().endsWith(ending))?.name ?? `${name}${ending}`;
  const newSkeleton = before?.skeleton !== after.skeleton;
  for (const skin of after.skins) {
    const isNew = !before?.skins.includes(skin);
    const file = fileOf(skin.name, '.skin');
    if (after.skeleton && (isNew || newSkeleton)) problems.push(...checkSkin(skin, after.skeleton, file));
    const texture = skin.material?.texture;
    if (isNew && texture !== undefined && !after.textures.some((t) => sameName(t.name, baseName(texture)))) {
      problems.push(textureNotGiven(file, texture));
    }
  }
  const skin = shownSkin(after);
  for (const morph of after.morphs) {
    const isNew = !before?.morphs.includes(morph) || (skin && !before.skins.includes(skin));
    if (skin && isNew) problems.push(...checkMorph(morph, skin, fileOf(morph.name, '.morph')));
  }
  const clip = shownClip(after);
  if (clip && after.skeleton && (newSkeleton || !before?.clips.includes(clip))) {
    const changedDofs = jointDofCount(before?.skeleton) !== jointDofCount(after.skeleton);
    if (changedDofs || !before?.clips.includes(clip)) {
      problems.push(...checkClip(clip, after.skeleton, after.morphs.length, fileOf(clip.name, '.anim')));
    }
  }
  return problems;
}

function textureNotGiven(file: string, texture: string): Diagnostic {
  return {
    severity: 'warning',
    code: 'texture-not-given',
    message: `The texture "${texture}" that the skin names was not among the files given.`,
    file,
    line: 0,
    column: 0,
    assumed: 'drawn untextured',
  };
}

/** Why good files were not opened: they belong with one that has errors. */
function heldBack(members: readonly GivenFile[], holes: readonly GivenFile[]): Diagnostic[] {
  const culprit = holes[0].source.name;
  return members.filter(isRead).map((member) => ({
    severity: 'info',
    code: 'held-back',
    message: `Not opened, because it belongs with ${culprit}, which has errors.`,
    file: member.source.name,
    line: 0,
    column: 0,
  }));
}

function openLabel(files: readonly ParsedFile[]): string {
  const first = files[0]?.source.name ?? 'files';
  return files.length > 1 ? `Open ${first} and ${files.length - 1} more` : `Open ${first}`;
}
