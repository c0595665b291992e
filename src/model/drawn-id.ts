/**
 * The view's id of a character: its document id, or, for the second of two compared takes, the id of its twin. Picking
 * returns document ids (`Viewport.pick`), so no tool needs to know about twins.
 */
export type TwinId = `${string}#twin`;

/** The view's id of a character's twin, the second of two compared takes. */
export function twinOf(characterId: string): TwinId {
  return `${characterId}#twin`;
}

/**
 * The document's character behind one that is drawn. Document ids are generated (`c1`, `c2` …), so only a twin's
 * contains a #.
 */
export function characterIdOf(drawnId: string): string {
  const end = drawnId.indexOf('#');
  return end < 0 ? drawnId : drawnId.slice(0, end);
}
