/** Pictures that a skin's material may name. Their bytes are kept as they are; the view decodes them. */
const TYPES: ReadonlyMap<string, string> = new Map([
  ['bmp', 'image/bmp'],
  ['png', 'image/png'],
  ['jpg', 'image/jpeg'],
  ['jpeg', 'image/jpeg'],
  ['webp', 'image/webp'],
]);

/** Without dots. */
export const TEXTURE_EXTENSIONS: readonly string[] = [...TYPES.keys()];

/** The MIME type that a picture's name tells, in any case; undefined for a file of another kind. */
export function textureTypeOf(fileName: string): string | undefined {
  return TYPES.get(fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase());
}
