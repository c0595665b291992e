/**
 * Unkeyed changes are stored beside pose and take, for one time: they are shown and can be keyed at that time, and are
 * discarded at any other. Nothing else refers to them, so discarding leaves no trace.
 */
import type { Character, Document } from '../model/document.ts';

/** The unkeyed changes at this time, by DOF; a new map. Empty for any other time. */
export function unkeyedAt({ unkeyed }: Character, timeSeconds: number): Map<number, number> {
  const values = new Map<number, number>();
  if (unkeyed?.timeSeconds !== timeSeconds) return values;
  for (const [i, dof] of unkeyed.dofs.entries()) values.set(dof, unkeyed.values[i]);
  return values;
}

/** The character with exactly these unkeyed changes. */
export function withUnkeyed(character: Character, timeSeconds: number, values: ReadonlyMap<number, number>): Character {
  const before = unkeyedAt(character, timeSeconds);
  const same = before.size === values.size && [...values].every(([dof, value]) => before.get(dof) === value);
  if (same && (values.size > 0 || !character.unkeyed)) return character;
  if (values.size === 0) return withoutUnkeyed(character);
  const dofs = [...values.keys()].sort((a, b) => a - b);
  return { ...character, unkeyed: { timeSeconds, dofs, values: dofs.map((dof) => values.get(dof) ?? 0) } };
}

/** The character without unkeyed changes; the same object if it has none. */
export function withoutUnkeyed(character: Character): Character {
  if (!character.unkeyed) return character;
  const { unkeyed: _gone, ...rest } = character;
  return rest;
}

/** Number of unkeyed changes in the document, except those of one transport time. Null for no exception. */
export function countUnkeyed({ characters }: Document, exceptSeconds: number | null): number {
  return characters.reduce((sum, c) => sum + (isOfAnother(c, exceptSeconds) ? (c.unkeyed?.dofs.length ?? 0) : 0), 0);
}

/** The document without those values; the same object if there are none. */
export function documentWithoutUnkeyed(document: Document, exceptSeconds: number | null): Document {
  const gone = (character: Character) => isOfAnother(character, exceptSeconds);
  if (!document.characters.some(gone)) return document;
  return { ...document, characters: document.characters.map((c) => (gone(c) ? withoutUnkeyed(c) : c)) };
}

function isOfAnother({ unkeyed }: Character, timeSeconds: number | null): boolean {
  return unkeyed !== undefined && unkeyed.timeSeconds !== timeSeconds;
}
