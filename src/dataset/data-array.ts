/** Arrays of numbers or texts with a name and a shape, independent of the file that they are written to. */

/** Numbers in either precision. */
export type Floats = Float32Array | Float64Array;

interface Named {
  readonly name: string;
  /** Empty for a single value; row-major. */
  readonly shape: readonly number[];
}

/** A named array of numbers, booleans or texts, told by `type`, in row-major order. */
export type DataArray = Named &
  (
    | { readonly type: 'float'; readonly data: Floats }
    | { readonly type: 'int'; readonly data: Int32Array }
    /** 0 or 1. */
    | { readonly type: 'bool'; readonly data: Uint8Array }
    | { readonly type: 'text'; readonly data: readonly string[] }
  );

/** Number of values of a shape. */
export function sizeOf(shape: readonly number[]): number {
  return shape.reduce((product, length) => product * length, 1);
}
