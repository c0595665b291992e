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

/**
 * How many values are set by hand in all of the document; without those of one moment of the transport.
 * Null stands for no moment.
 */
export function countUnkeyed({ characters }: Document, exceptSeconds: number | null): number {
  return characters.reduce((sum, c) => sum + (isOfAnother(c, exceptSeconds) ? (c.unkeyed?.dofs.length ?? 0) : 0), 0);
}

/** The document without those values; the same object where there is none. */
export function documentWithoutUnkeyed(document: Document, exceptSeconds: number | null): Document {
  const gone = (character: Character) => isOfAnother(character, exceptSeconds);
  if (!document.characters.some(gone)) return document;
  return { ...document, characters: document.characters.map((c) => (gone(c) ? withoutUnkeyed(c) : c)) };
}

function isOfAnother({ unkeyed }: Character, timeSeconds: number | null): boolean {
  return unkeyed !== undefined && unkeyed.timeSeconds !== timeSeconds;
}
