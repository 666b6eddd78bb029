// Viridis (S. van der Walt, N. Smith, 2015, CC0): perceptually uniform and readable with colour-blind eyes.
// Seventeen of its colours, linear between them; the largest difference to the full table is below what an eye sees.
const anchors = [
  "440154", "48186a", "472d7b", "424086", "3b528b", "33638d", "2c728e", "26828e", "21918c",
  "1f9f88", "27ad81", "3dbc74", "5cc863", "81d34d", "aadc32", "d5e21a", "fde725",
].map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)) as [number, number, number]);

/** 256 colours, each packed as the ABGR word of a little-endian ImageData. */
export const colourTable: Uint32Array = (() => {
  const table = new Uint32Array(256);
  for (let i = 0; i < 256; i++) {
    const [r, g, b] = colour(i / 255);
    table[i] = (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
  }
  return table;
})();

/** Red, green and blue, 0 to 255, at 0 <= t <= 1. */
export function colour(t: number): [number, number, number] {
  const x = Math.min(1, Math.max(0, t)) * (anchors.length - 1);
  const k = Math.min(anchors.length - 2, Math.floor(x));
  const low = anchors[k]!;
  const high = anchors[k + 1]!;
  return [0, 1, 2].map((c) => Math.round(low[c]! + (x - k) * (high[c]! - low[c]!))) as [number, number, number];
}

/** `count` colours in order, clear of the end that vanishes on the page's background. */
export function sequence(count: number, dark: boolean): string[] {
  const [from, to] = dark ? [0.28, 1] : [0.02, 0.84];
  return Array.from({ length: count }, (_, i) => {
    const t = count < 2 ? 0.5 * (from + to) : from + ((to - from) * i) / (count - 1);
    return `rgb(${colour(t).join(" ")})`;
  });
}
