// Numbers for people: ticks of axes, short texts. Nothing here is computed with.

/** Steps of 1, 2 or 5 times a power of ten, about `wanted` of them. */
export function ticks(from: number, to: number, wanted: number): number[] {
  const span = to - from;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const raw = span / Math.max(wanted, 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= raw * 0.999) ?? power;
  const list: number[] = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + step * 1e-9 && list.length < 100; ++k) list.push(k * step);
  return list;
}

/** A text of few digits, with a true minus sign. */
export function short(value: number, digits = 4): string {
  if (Number.isNaN(value)) return "none";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  const text = size !== 0 && (size >= 1e5 || size < 1e-3) ? value.toExponential(Math.max(digits - 2, 0)) : String(Number(value.toPrecision(digits)));
  return text.replace("e+", "e").replaceAll("-", "−");
}

/** Texts of ticks, with as many digits as tell them apart. */
export function tickTexts(values: readonly number[]): string[] {
  const step = values.length > 1 ? Math.abs((values[1] ?? 0) - (values[0] ?? 0)) : 1;
  const largest = Math.max(...values.map(Math.abs), step);
  if (largest >= 1e5 || largest < 1e-3) {
    const power = Math.floor(Math.log10(largest));
    const decimals = Math.max(0, Math.ceil(power - Math.log10(step) - 1e-9));
    return values.map((value) => (value === 0 ? "0" : `${(value / 10 ** power).toFixed(decimals)}e${power}`.replaceAll("-", "−")));
  }
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  return values.map((value) => (Math.abs(value) < step * 1e-6 ? 0 : value).toFixed(decimals).replaceAll("-", "−"));
}

/** The ends of a slider for a parameter: within its range, and about as far as a person will go. */
export function sliderRange(value: number, least: number, most: number, preset?: [number, number]): [number, number] {
  if (preset) return [Math.min(preset[0], value), Math.max(preset[1], value)];
  if (Number.isFinite(least) && Number.isFinite(most)) return [least, most];
  const size = value === 0 ? 1 : Math.abs(value);
  const top = nice(3 * size);
  const low = Number.isFinite(least) ? least : value < 0 ? -top : value === 0 ? -1 : 0;
  return [Math.max(low, Number.isFinite(least) ? least : -Infinity), Math.min(Number.isFinite(most) ? most : Infinity, Math.max(top, value))];
}

/** The next 1, 2 or 5 times a power of ten. */
export function nice(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5, 10].find((factor) => factor * power >= value * 0.999) ?? 10) * power;
}

/** A parameter's sign as papers write it: omega is ω. */
export function symbol(name: string): string {
  const greek: Record<string, string> = { omega: "ω", phase: "τ", alpha: "α", beta: "β", gamma: "γ", mu: "μ" };
  return greek[name] ?? name.replaceAll("_", " ");
}
