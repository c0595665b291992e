/**
 * How the picture knows a character: by its id, or, where two takes of one character are compared, the second of them
 * as its twin. What is picked is told by the document's id again (`Viewport.pick`), so that no tool needs to know.
 */
export type TwinId = `${string}#twin`;

export function twinOf(characterId: string): TwinId {
  return `${characterId}#twin`;
}

/** The document's character behind one that is drawn. Ids are made here, `c1`, `c2` …: none but a twin's has a #. */
export function characterIdOf(drawnId: string): string {
  const end = drawnId.indexOf('#');
  return end < 0 ? drawnId : drawnId.slice(0, end);
}
