// node spectrum_test.mjs: the report's spectra of signals that are known (web/src/spectrum.ts).
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(new URL("../../web/package.json", import.meta.url));
const source = readFileSync(new URL("../../web/src/spectrum.ts", import.meta.url), "utf8");
const { code } = require("esbuild").transformSync(source, { loader: "ts", format: "esm" });
const { transform, evenly, spectrum, orderLines, orderTrack, pieces } = await import(`data:text/javascript,${encodeURIComponent(code)}`);

const series = (count, step, of, jitter = () => 0) => {
  const x = Float64Array.from({ length: count }, (_, i) => step * (i + jitter(i)));
  return [x, x.map(of)];
};
const near = (found, wanted, tolerance, what) => assert.ok(Math.abs(found - wanted) <= tolerance, `${what}: ${found}, expected ${wanted} within ${tolerance}`);
const peakOf = ({ frequency, amplitude }, low = 0, high = Infinity) => {
  let best = -1;
  frequency.forEach((f, i) => f >= low && f <= high && (best < 0 || amplitude[i] > amplitude[best]) && (best = i));
  return { frequency: frequency[best], amplitude: amplitude[best] };
};

const tests = {
  Transform_IsTheSumOfItsDefinition() {
    const n = 16;
    const [re, im] = [Float64Array.from({ length: n }, (_, i) => ((i * 7) % 5) - 1.5), Float64Array.from({ length: n }, (_, i) => (i * i) % 3)];
    const [a, b] = [re.slice(), im.slice()];
    transform(a, b);
    for (let k = 0; k < n; k++) {
      let [x, y] = [0, 0];
      for (let i = 0; i < n; i++) {
        const t = (-2 * Math.PI * i * k) / n;
        x += re[i] * Math.cos(t) - im[i] * Math.sin(t);
        y += re[i] * Math.sin(t) + im[i] * Math.cos(t);
      }
      near(a[k], x, 1e-13 * n, `real part of line ${k}`); // round-off of n terms of order 1
      near(b[k], y, 1e-13 * n, `imaginary part of line ${k}`);
    }
  },

  EvenRows_KeepTheirValues_AndParabolasBetween() {
    const [x, y] = series(20, 0.5, (t) => 3 - t + 2 * t * t, (i) => 0.3 * Math.sin(i));
    const inner = evenly(x, y, x[2], (x[17] - x[2]) / 40, 41);
    inner.forEach((v, i) => {
      const t = x[2] + (i * (x[17] - x[2])) / 40;
      near(v, 3 - t + 2 * t * t, 1e-11, `parabola at ${t}`); // round-off of values of order 200
    });
  },

  Spectrum_OfTwoSines_HasTheirFrequenciesAndAmplitudes() {
    const [time, y] = series(1500, 1e-3, (t) => 40 + 3 * Math.sin(2 * Math.PI * 37.3 * t) + 0.5 * Math.cos(2 * Math.PI * 121 * t));
    const found = spectrum(time, y);
    // Lines are 1/(4 T) apart or closer; midway between two, Hann's window is 1.3 % lower at 1/8 line of its own.
    const line = found.frequency[1];
    assert.ok(line <= 1 / (4 * 1.499) + 1e-12);
    for (const [f, a] of [[37.3, 3], [121, 0.5]]) {
      const peak = peakOf(found, f - 10, f + 10);
      near(peak.frequency, f, 0.51 * line, "frequency");
      near(peak.amplitude, a, 0.015 * a, "amplitude");
    }
    assert.ok(peakOf(found, 0, 20).amplitude < 0.01, "the mean has left something");
  },

  Spectrum_OfUnevenRows_IsTheSame() {
    const of = (t) => 2 * Math.sin(2 * Math.PI * 25 * t);
    const found = spectrum(...series(1000, 1e-3, of, (i) => 0.4 * Math.sin(1.7 * i)));
    // 40 rows a period, cubic between them: a thousandth, beside the line's 1.3 %.
    near(peakOf(found).frequency, 25, 0.51 * found.frequency[1], "frequency");
    near(peakOf(found).amplitude, 2, 0.03, "amplitude");
  },

  OrderLines_OfACycle_AreExact() {
    // Four-stroke: two turns, whose lines are half orders; 512 rows, of which the transform takes every one.
    const [turns, y] = series(2 * 512 + 1, 2 / 512, (a) => 1 + 0.7 * Math.cos(Math.PI * a) + 2 * Math.sin(2 * Math.PI * a) - 0.1 * Math.cos(2 * Math.PI * 5 * a));
    const { frequency, amplitude } = orderLines(turns, y, 2);
    const wanted = { 0.5: 0.7, 1: 2, 5: 0.1 };
    frequency.forEach((order, i) => order <= 20 && near(amplitude[i], wanted[order] ?? 0, 2e-5, `order ${order}`)); // cubic between rows: (2 pi 5/256)^4/384
  },

  OrderTrack_OfARunUp_FollowsTheAmplitudeOfItsOrder() {
    // Angle a = t^2: the amplitude of order 1 grows with the angle, order 3 stays.
    const time = Float64Array.from({ length: 4000 }, (_, i) => i * 2e-3);
    const angle = time.map((t) => t * t);
    const y = angle.map((a) => 0.05 * a * Math.cos(2 * Math.PI * a + 0.3) + 0.4 * Math.sin(2 * Math.PI * 3 * a));
    const at = Float64Array.from([10, 20, 40]);
    const [first, third, second] = [1, 3, 2].map((order) => orderTrack(angle, y, order, 8, at));
    at.forEach((a, i) => {
      near(first[i], 0.05 * a, 0.01 * 0.05 * a, "order 1"); // linear in the window: its mean is exact, the rest cubic rows
      near(third[i], 0.4, 0.01 * 0.4, "order 3");
      assert.ok(second[i] < 0.01, `order 2 has ${second[i]}`);
    });
  },

  Pieces_OfAChirp_FollowItsFrequency() {
    const [time, y] = series(8000, 1e-3, (t) => Math.sin(2 * Math.PI * (10 * t + 5 * t * t)));
    const found = pieces(time, y, 20);
    assert.ok(found.length >= 19);
    for (const piece of found.slice(1, -1)) {
      const { frequency } = peakOf(piece);
      near(frequency, 10 + 10 * piece.at, 4, "frequency at the middle of the piece"); // it sweeps 8 Hz within one
    }
  },
};

for (const [name, test] of Object.entries(tests)) {
  test();
  console.log(`  ok    ${name}`);
}
