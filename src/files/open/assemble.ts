/** Assembles a character from the files that belong to it, and reports parts that don't fit. */

import { withoutUnkeyed } from '../../edit/unkeyed.ts';
import { withSkeleton } from '../../edit/with-skeleton.ts';
import { checkMorph, checkSkin, checkTake } from '../../evaluate/skin/binding.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, shownSkin, shownTake } from '../../model/document.ts';
import {
  type AcclaimTake,
  baseName,
  type FileNaming,
  folderOf,
  type ParsedFile,
  type SourceFile,
  sameName,
  type Texture,
  type WholeCharacter,
} from '../../model/files.ts';
import type { Morph } from '../../model/morph.ts';
import { NO_MARKS, type PartFile, type PartMark, type PartMarks, readAs, UNMARKED } from '../../model/part.ts';
import { jointDofCount } from '../../model/skeleton/dofs.ts';
import { ownChannels } from '../../model/skeleton/skel-motion.ts';
import { type Skin, textureNames } from '../../model/skin.ts';
import type { Space } from '../../model/space.ts';
import { layerCode } from '../../model/takes/layer-code.ts';
import { firstTake } from '../../model/takes/moving.ts';
import type { Take } from '../../model/takes/take.ts';
import { renamedTake } from '../../model/takes/tracked-take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';

/** Where a part comes from. */
export interface PartOrigin extends Omit<PartFile, 'holds'> {
  /**
   * The character before these files were opened: only its parts are replaced, so two new files of the same name become
   * two parts.
   */
  readonly before: Character | undefined;
}

/** Lists a file among the character's sources, replacing one of the same name that it had before. */
export function withSource(character: Character, source: SourceFile, before: Character | undefined): Character {
  const replaced = (s: SourceFile) => sameName(s.name, source.name) && (before?.sources.includes(s) ?? false);
  const next = { ...character, sources: [...character.sources.filter((s) => !replaced(s)), source] };
  return withUnread(next, next.unread?.filter(({ name }) => !sameName(name, source.name)) ?? []);
}

/** The character with these as the files that could not be read. */
export function withUnread(character: Character, unread: readonly SourceFile[]): Character {
  if (unread.length === (character.unread?.length ?? 0)) return character;
  const { unread: _before, ...rest } = character;
  return unread.length > 0 ? { ...rest, unread } : rest;
}

/** Adds a skin, or replaces the one of that name, and shows it. */
export function withSkin(character: Character, skin: Skin, from: PartOrigin): Character {
  const { skins } = character;
  const at = replacedIndex(skins, from.before?.skins, skin.name);
  const parts = withMark(character, 'skins', at, skin.name, from);
  return { ...character, parts, skins: put(skins, at, skin), shownSkin: at < 0 ? skins.length : at };
}

/** Adds a morph, or replaces the one of that name. */
export function withMorph(character: Character, morph: Morph, from: PartOrigin): Character {
  const { morphs } = character;
  const at = replacedIndex(morphs, from.before?.morphs, morph.name);
  const parts = withMark(character, 'morphs', at, morph.name, from);
  const pose = at < 0 ? [...character.pose, morph.weight ?? 0] : character.pose;
  return { ...withoutUnkeyed(character), parts, morphs: put(morphs, at, morph), pose };
}

/** Adds a take, or replaces the one of that name, and shows it. */
export function withTake(character: Character, take: Take, from: PartOrigin): Character {
  const { takes } = character;
  const at = takeReadBefore(character, take, from);
  const parts = withMark(character, 'takes', at, take.name, from);
  // Its own file holds no markers: reading it again doesn't remove them.
  const kept = take.markers ? undefined : takes[at]?.markers;
  const marked = kept ? withMarkers(take, kept) : take;
  // A take among others of its file may have been given another name.
  const isItself = at < 0 || from.kind !== 'character' || takes[at].name === marked.name;
  const named = isItself ? marked : renamedTake(marked, takes[at].name);
  return { ...character, parts, takes: put(takes, at, named), shownTake: at < 0 ? takes.length : at };
}

/** Adds a take that comes with its skeleton, which a character without one gets. */
export function withAcclaimTake(character: Character, read: AcclaimTake, from: PartOrigin): Character {
  const { take, space } = read;
  const kept = character.skeleton ? character : withSkeletonOf(character, read, from);
  // Of a skeleton alone, the unit was told by its rest pose.
  const isFirst = character.takes.length === 0 && kept.space?.known !== undefined;
  return withTake(isFirst && space ? { ...kept, space: space.space } : kept, take, from);
}

function withSkeletonOf(character: Character, { skeleton, space, of }: AcclaimTake, from: PartOrigin): Character {
  const { before } = from;
  const whole = { skeleton, skins: [], morphs: [], takes: [], textures: [], clampsToLimits: false } as const;
  const origin: PartOrigin = of ? { kind: 'asf', source: of, before } : from;
  return withWhole(of ? withSource(character, of, before) : character, whole, origin, space?.space);
}

/** Index of the take that is read again; -1 if it is new. */
function takeReadBefore(character: Character, { name }: Take, { kind, source, before }: PartOrigin): number {
  const { takes, parts = NO_MARKS } = character;
  const isSame = ({ file }: PartMark) =>
    file?.kind === 'character' && file.holds === name && sameName(file.source.name, source.name);
  const known = kind === 'character' ? parts.takes.findIndex(isSame) : -1;
  return before?.takes.includes(takes[known]) ? known : replacedIndex(takes, before?.takes, name);
}

/** The marks with that of a part from a file, replacing the one at `at`, or appended if `at` is -1. */
function withMark(
  character: Character,
  key: 'skins' | 'morphs' | 'takes',
  at: number,
  holds: string,
  { kind, source }: PartOrigin,
): PartMarks {
  const { parts = NO_MARKS } = character;
  const marks = character[key].map((_, i) => parts[key][i] ?? UNMARKED);
  return { ...parts, [key]: put(marks, at, readAs(marks[at], { kind, source, holds })) };
}

interface Named {
  readonly name: string;
}

/** Index of the part of that name that existed before; -1 if none did. */
function replacedIndex(parts: readonly Named[], before: readonly Named[] | undefined, name: string): number {
  return parts.findIndex((part) => part.name === name && before?.includes(part));
}

function put<T>(list: readonly T[], at: number, item: T): readonly T[] {
  return at < 0 ? [...list, item] : list.map((old, i) => (i === at ? item : old));
}

function withTexture(character: Character, texture: Texture): Character {
  return { ...character, textures: [...character.textures.filter((t) => !sameName(t.name, texture.name)), texture] };
}

/** Gives a character's skins the textures that they name; the same character if there are none. */
export function withTextures(character: Character, given: readonly ParsedFile[]): Character {
  const skinFolders = character.parts?.skins.flatMap(({ file }) => (file ? folderOf(file.source) : [])) ?? [];
  let next = character;
  for (const wanted of new Set(character.skins.flatMap(textureNames))) {
    const fits = given.filter((f) => f.kind === 'texture' && sameName(f.source.name, baseName(wanted)));
    const file = fits.find((f) => skinFolders.includes(folderOf(f.source))) ?? fits[0];
    if (file?.kind !== 'texture' || next.textures.includes(file.texture)) continue;
    next = {
      ...withTexture(next, file.texture),
      sources: [...next.sources.filter((s) => !sameName(s.name, file.source.name)), file.source],
    };
  }
  return next;
}

/**
 * Uses a character of a file: its skeleton with all that comes with it. Its first skin is shown, and its first take
 * that moves.
 */
export function withWhole(
  character: Character,
  whole: WholeCharacter,
  from: PartOrigin,
  space: Space | undefined,
): Character {
  const { skeleton, skins, morphs, takes, textures } = whole;
  const { parts = NO_MARKS } = character;
  const { kind, source } = from;
  const mark = readAs(parts.skeleton, { kind, source, holds: skeleton.name });
  // Takes that waited for a skeleton have the order of channels that files have.
  const waiting = character.skeleton ? character.takes : character.takes.map((take) => ownChannels(take, skeleton, []));
  let next: Character = {
    ...withSkeleton({ ...character, takes: waiting }, skeleton),
    parts: { ...parts, skeleton: mark },
    ...(space && { space }),
    ...(whole.clampsToLimits === false && !character.skeleton && { clampsToLimits: false }),
  };
  for (const skin of skins) next = withSkin(next, skin, from);
  for (const morph of morphs) next = withMorph(next, morph, from);
  for (const take of takes) next = withTake(next, take, from);
  for (const texture of textures) next = withTexture(next, texture);
  const shown = takes[firstTake(takes)];
  return {
    ...next,
    ...(skins.length && { shownSkin: next.skins.indexOf(skins[0]) }),
    ...(shown && { shownTake: takeReadBefore(next, shown, { ...from, before: next }) }),
  };
}

/** The character with the takes of another one, which has nothing else. */
export function withTakesOf(character: Character, { takes, parts = NO_MARKS, sources }: Character): Character {
  const { skeleton, pose, parts: own = NO_MARKS } = character;
  const taken = skeleton ? takes.map((take) => ownChannels(take, skeleton, pose)) : takes;
  const marks = character.takes.map((_, i) => own.takes[i] ?? UNMARKED);
  const all = [...character.takes, ...taken];
  return {
    ...character,
    takes: all,
    parts: { ...own, takes: [...marks, ...takes.map((_, i) => parts.takes[i] ?? UNMARKED)] },
    sources: [...character.sources, ...sources],
    shownTake: firstTake(all),
  };
}

/** Reports parts of a character that don't fit; only pairs of which at least one is new. */
export function checkParts(before: Character | undefined, after: Character, naming: FileNaming): Diagnostic[] {
  const problems: Diagnostic[] = [];
  const newSkeleton = before?.skeleton !== after.skeleton;
  const { parts = NO_MARKS } = after;
  // Several skins of one file may name the same.
  const missing = new Set<string>();
  const called = (mark: PartMark | undefined, otherwise: string) => (mark?.file ? naming(mark.file.source) : otherwise);
  after.skins.forEach((skin, i) => {
    const isNew = !before?.skins.includes(skin);
    const file = called(parts.skins[i], `${skin.name}.skin`);
    if (after.skeleton && (isNew || newSkeleton)) problems.push(...checkSkin(skin, after.skeleton, file));
    for (const texture of isNew ? textureNames(skin) : []) {
      const key = `${file} ${texture}`;
      if (missing.has(key) || after.textures.some((t) => sameName(t.name, baseName(texture)))) continue;
      missing.add(key);
      const message = `The texture "${texture}" named by the skin was not among the files.`;
      const problem = withoutPlace('warning', 'texture-not-given', message, file, 'drawn without texture');
      problems.push({ ...problem, missing: baseName(texture) });
    }
  });
  const skin = shownSkin(after);
  after.morphs.forEach((morph, i) => {
    const isNew = !before?.morphs.includes(morph) || (skin && !before.skins.includes(skin));
    if (skin && isNew) problems.push(...checkMorph(morph, skin, called(parts.morphs[i], `${morph.name}.morph`)));
  });
  for (const each of after.takes) {
    if (each.layers && (newSkeleton || !before?.takes.includes(each))) {
      problems.push(...layerCode(each).unknownJoints(each, after));
    }
  }
  const take = shownTake(after);
  const needsAnother = newSkeleton && jointDofCount(before?.skeleton) !== jointDofCount(after.skeleton);
  if (take && after.skeleton && (needsAnother || !before?.takes.includes(take))) {
    const file = called(parts.takes[after.shownTake], `${take.name}.anim`);
    problems.push(...checkTake(take, after.skeleton, after.morphs.length, file));
  }
  return problems;
}
