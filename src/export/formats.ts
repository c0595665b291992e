/** The formats of other programs that whole characters are written in, by extension, with what they are called. */
export const EXCHANGE_LABELS = { glb: 'GLB', fbx: 'FBX', vrma: 'VRM animation' } as const;

/** An extension of `EXCHANGE_LABELS`. */
export type ExchangeFormat = keyof typeof EXCHANGE_LABELS;
/** All of them. */
export const EXCHANGE_FORMATS = Object.keys(EXCHANGE_LABELS) as readonly ExchangeFormat[];

/** Whether an extension is one of these formats. */
export function isExchange(extension: string): extension is ExchangeFormat {
  return Object.hasOwn(EXCHANGE_LABELS, extension);
}

/** The format that a file's name asks for; undefined if it is none of these. */
export function exchangeOf(name: string): ExchangeFormat | undefined {
  return EXCHANGE_FORMATS.find((format) => name.toLowerCase().endsWith(`.${format}`));
}
