/**
 * What is set by hand over keys stands beside pose and clip, for one moment: it is shown there, can be keyed there, and
 * is gone at any other time. Nothing else knows of it, so it goes without a trace.
 */
import type { Character, Document } from '../model/document.ts';

/** The values set by hand at this moment, by DOF; a new map. What was set at another moment is none of them. */
export function unkeyedAt({ unkeyed }: Character, timeSeconds: number): Map<number, number> {
  const values = new Map<number, number>();
  if (unkeyed?.timeSeconds !== timeSeconds) return values;
  for (const [i, dof] of unkeyed.dofs.entries()) values.set(dof, unkeyed.values[i]);
  return values;
}

/** The character with exactly these values set by hand; with none where there are none. */
export function withUnkeyed(character: Character, timeSeconds: number, values: ReadonlyMap<number, number>): Character {
  const before = unkeyedAt(character, timeSeconds);
  const same = before.size === values.size && [...values].every(([dof, value]) => before.get(dof) === value);
  if (same && (values.size > 0 || !character.unkeyed)) return character;
  if (values.size === 0) return withoutUnkeyed(character);
  const dofs = [...values.keys()].sort((a, b) => a - b);
  return { ...character, unkeyed: { timeSeconds, dofs, values: dofs.map((dof) => values.get(dof) ?? 0) } };
}

export function withoutUnkeyed(character: Character): Character {
  if (!character.unkeyed) return character;
  const { unkeyed: _gone, ...rest } = character;
  return rest;
}

/** How many values were set by hand at another time than this. */
export function countStale(document: Document, timeSeconds: number): number {
  return document.characters.reduce((sum, c) => sum + (isStale(c, timeSeconds) ? (c.unkeyed?.dofs.length ?? 0) : 0), 0);
}

/** The document without what was set by hand at another time than this; the same object where there is nothing. */
export function dropUnkeyed(document: Document, timeSeconds: number): Document {
  return dropWhere(document, (c) => isStale(c, timeSeconds));
}

/** The document without anything set by hand and not keyed. */
export function dropAllUnkeyed(document: Document): Document {
  return dropWhere(document, (c) => c.unkeyed !== undefined);
}

function isStale({ unkeyed }: Character, timeSeconds: number): boolean {
  return unkeyed !== undefined && unkeyed.timeSeconds !== timeSeconds;
}

function dropWhere(document: Document, gone: (character: Character) => boolean): Document {
  if (!document.characters.some(gone)) return document;
  return { ...document, characters: document.characters.map((c) => (gone(c) ? withoutUnkeyed(c) : c)) };
}
