/**
 * Thrift's compact protocol, as far as Parquet's metadata need it.
 *
 *     field      delta of the field's number ≪ 4 | type        struct     fields, then 0
 *     integer    zigzag, 7 bits a byte, the lowest first        text       length, UTF-8
 *     list       count ≪ 4 | type, or 0xf0 | type and the count from 15
 */

/** A value with its type in Thrift's compact protocol. */
export type ThriftValue =
  | { readonly i32: number }
  | { readonly i64: number }
  | { readonly text: string }
  | { readonly struct: ThriftFields }
  | { readonly list: readonly ThriftValue[] };

/** By number, ascending. */
export type ThriftFields = readonly (readonly [number: number, value: ThriftValue])[];

/** A struct, whole. */
export function thriftBytes(fields: ThriftFields): Uint8Array {
  const out: number[] = [];
  putStruct(fields, out);
  return Uint8Array.from(out);
}

function putStruct(fields: ThriftFields, out: number[]): void {
  let last = 0;
  for (const [number, value] of fields) {
    out.push(((number - last) << 4) | typeOf(value));
    put(value, out);
    last = number;
  }
  out.push(0);
}

function typeOf(value: ThriftValue): number {
  if ('i32' in value) return 5;
  if ('i64' in value) return 6;
  if ('text' in value) return 8;
  return 'list' in value ? 9 : 12;
}

function put(value: ThriftValue, out: number[]): void {
  if ('i32' in value) putNumber(2 * value.i32, out);
  else if ('i64' in value) putNumber(2 * value.i64, out);
  else if ('text' in value) {
    const bytes = new TextEncoder().encode(value.text);
    putNumber(bytes.length, out);
    for (const byte of bytes) out.push(byte);
  } else if ('list' in value) {
    const { list } = value;
    const type = typeOf(list[0] ?? { i32: 0 });
    if (list.length < 15) out.push((list.length << 4) | type);
    else {
      out.push(0xf0 | type);
      putNumber(list.length, out);
    }
    for (const each of list) put(each, out);
  } else putStruct(value.struct, out);
}

/** Not negative, and up to 2⁵³. */
function putNumber(value: number, out: number[]): void {
  let rest = value;
  while (rest >= 0x80) {
    out.push((rest % 0x80) | 0x80);
    rest = Math.floor(rest / 0x80);
  }
  out.push(rest);
}
