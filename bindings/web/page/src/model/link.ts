// A state as a link: the scenario's text, packed into the part of the address that no server sees, and the time that is shown.

/** Longest packed text that is taken, characters. */
const PACKED_MAX = 200_000;
/** Longest text that comes out, bytes. */
const TEXT_MAX = 1 << 20;

export interface Shared {
  text: string;
  /** Time since the scenario began, s. */
  time_s: number;
}

async function through(bytes: Uint8Array<ArrayBuffer>, stream: GenericTransformStream): Promise<Uint8Array> {
  const reader = (new Blob([bytes]).stream().pipeThrough(stream) as ReadableStream<Uint8Array>).getReader();
  const parts: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > TEXT_MAX) throw new RangeError("the scenario in this link is too long");
    parts.push(value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** The part of an address after `#`. */
export async function pack({ text, time_s }: Shared): Promise<string> {
  const packed = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const letters = btoa(String.fromCharCode(...packed)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  return `#t=${Number(time_s.toFixed(6))}&s=${letters}`;
}

/** What a link says; null if it says nothing. Throws if it is broken. */
export async function unpack(hash: string): Promise<Shared | null> {
  const fields = new URLSearchParams(hash.replace(/^#/, ""));
  const packed = fields.get("s");
  if (packed === null) return null;
  if (packed.length > PACKED_MAX) throw new RangeError("this link is too long");
  const letters = atob(packed.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
  const text = new TextDecoder("utf-8", { fatal: true }).decode(await through(bytes, new DecompressionStream("deflate-raw")));
  const time_s = Number(fields.get("t") ?? 0);
  return { text, time_s: Number.isFinite(time_s) && time_s >= 0 ? time_s : 0 };
}
