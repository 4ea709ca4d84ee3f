// What draws: the same calls go to a canvas on the page and to an SVG file that is saved. Positions are in CSS pixels.

export interface Stroke {
  colour: string;
  width?: number;
  dash?: readonly number[];
  opacity?: number;
}

export interface TextStyle {
  colour: string;
  size?: number;
  anchor?: "start" | "middle" | "end";
  baseline?: "top" | "middle" | "bottom";
  turned?: boolean;
  weight?: number;
}

export interface Pen {
  /** A polyline x0, y0, x1, y1, ..; a NaN lifts the pen. */
  line(points: ArrayLike<number>, stroke: Stroke): void;
  /** A closed shape. */
  fill(points: ArrayLike<number>, colour: string, opacity?: number): void;
  rect(x: number, y: number, width: number, height: number, colour: string, opacity?: number): void;
  /** Square dots of a size around x0, y0, x1, y1, .. */
  dots(points: ArrayLike<number>, colour: string, size: number, opacity: number): void;
  circle(x: number, y: number, radius: number, fill: string | undefined, stroke?: Stroke): void;
  text(x: number, y: number, text: string, style: TextStyle): void;
  /** A picture of square pixels. */
  image(picture: HTMLCanvasElement, x: number, y: number, width: number, height: number): void;
  /** What `body` draws is cut to the rectangle. */
  clipped(x: number, y: number, width: number, height: number, body: () => void): void;
}

export const fontFamily = 'system-ui, "DejaVu Sans", sans-serif';

export class CanvasPen implements Pen {
  constructor(private readonly to: CanvasRenderingContext2D) {}

  line(points: ArrayLike<number>, { colour, width = 1.5, dash = [], opacity = 1 }: Stroke): void {
    const to = this.to;
    to.beginPath();
    let down = false;
    for (let i = 0; i + 1 < points.length; i += 2) {
      const x = points[i] as number, y = points[i + 1] as number;
      if (Number.isNaN(x) || Number.isNaN(y)) down = false;
      else if (down) to.lineTo(x, y);
      else {
        to.moveTo(x, y);
        down = true;
      }
    }
    to.strokeStyle = colour;
    to.lineWidth = width;
    to.lineJoin = "round";
    to.lineCap = "round";
    to.globalAlpha = opacity;
    to.setLineDash([...dash]);
    to.stroke();
    to.setLineDash([]);
    to.globalAlpha = 1;
  }

  fill(points: ArrayLike<number>, colour: string, opacity = 1): void {
    const to = this.to;
    to.beginPath();
    for (let i = 0; i + 1 < points.length; i += 2) to.lineTo(points[i] as number, points[i + 1] as number);
    to.closePath();
    to.globalAlpha = opacity;
    to.fillStyle = colour;
    to.fill();
    to.globalAlpha = 1;
  }

  rect(x: number, y: number, width: number, height: number, colour: string, opacity = 1): void {
    this.to.globalAlpha = opacity;
    this.to.fillStyle = colour;
    this.to.fillRect(x, y, width, height);
    this.to.globalAlpha = 1;
  }

  dots(points: ArrayLike<number>, colour: string, size: number, opacity: number): void {
    const to = this.to;
    to.globalAlpha = opacity;
    to.fillStyle = colour;
    for (let i = 0; i + 1 < points.length; i += 2)
      to.fillRect((points[i] as number) - size / 2, (points[i + 1] as number) - size / 2, size, size);
    to.globalAlpha = 1;
  }

  circle(x: number, y: number, radius: number, fill: string | undefined, stroke?: Stroke): void {
    const to = this.to;
    to.beginPath();
    to.arc(x, y, radius, 0, 2 * Math.PI);
    if (fill !== undefined) {
      to.fillStyle = fill;
      to.fill();
    }
    if (stroke) {
      to.globalAlpha = stroke.opacity ?? 1;
      to.strokeStyle = stroke.colour;
      to.lineWidth = stroke.width ?? 1.5;
      to.stroke();
      to.globalAlpha = 1;
    }
  }

  image(picture: HTMLCanvasElement, x: number, y: number, width: number, height: number): void {
    this.to.imageSmoothingEnabled = false;
    this.to.drawImage(picture, x, y, width, height);
  }

  text(x: number, y: number, text: string, { colour, size = 12, anchor = "start", baseline = "middle", turned = false, weight = 400 }: TextStyle): void {
    const to = this.to;
    to.save();
    to.translate(x, y);
    if (turned) to.rotate(-Math.PI / 2);
    to.font = `${weight} ${size}px ${fontFamily}`;
    to.textAlign = anchor === "middle" ? "center" : anchor;
    to.textBaseline = baseline;
    to.fillStyle = colour;
    to.fillText(text, 0, 0);
    to.restore();
  }

  clipped(x: number, y: number, width: number, height: number, body: () => void): void {
    this.to.save();
    this.to.beginPath();
    this.to.rect(x, y, width, height);
    this.to.clip();
    body();
    this.to.restore();
  }
}

const pixel = (value: number): string => String(Math.round(value * 100) / 100);
const escaped = (text: string): string => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

export class SvgPen implements Pen {
  private readonly parts: string[] = [];
  private clips = 0;

  line(points: ArrayLike<number>, { colour, width = 1.5, dash = [], opacity = 1 }: Stroke): void {
    let path = "", down = false;
    for (let i = 0; i + 1 < points.length; i += 2) {
      const x = points[i] as number, y = points[i + 1] as number;
      if (Number.isNaN(x) || Number.isNaN(y)) {
        down = false;
        continue;
      }
      path += `${down ? "L" : "M"}${pixel(x)} ${pixel(y)}`;
      down = true;
    }
    if (path === "") return;
    const dashes = dash.length > 0 ? ` stroke-dasharray="${dash.join(" ")}"` : "";
    this.parts.push(`<path d="${path}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linejoin="round" stroke-linecap="round" opacity="${opacity}"${dashes}/>`);
  }

  fill(points: ArrayLike<number>, colour: string, opacity = 1): void {
    let list = "";
    for (let i = 0; i + 1 < points.length; i += 2) list += `${pixel(points[i] as number)},${pixel(points[i + 1] as number)} `;
    this.parts.push(`<polygon points="${list.trim()}" fill="${colour}" opacity="${opacity}"/>`);
  }

  rect(x: number, y: number, width: number, height: number, colour: string, opacity = 1): void {
    this.parts.push(`<rect x="${pixel(x)}" y="${pixel(y)}" width="${pixel(width)}" height="${pixel(height)}" fill="${colour}" opacity="${opacity}"/>`);
  }

  /** One path of strokes without length, which square caps make to dots. */
  dots(points: ArrayLike<number>, colour: string, size: number, opacity: number): void {
    let path = "";
    for (let i = 0; i + 1 < points.length; i += 2) path += `M${pixel(points[i] as number)} ${pixel(points[i + 1] as number)}h0`;
    if (path !== "")
      this.parts.push(`<path d="${path}" stroke="${colour}" stroke-width="${size}" stroke-linecap="square" opacity="${opacity}"/>`);
  }

  circle(x: number, y: number, radius: number, fill: string | undefined, stroke?: Stroke): void {
    const line = stroke ? ` stroke="${stroke.colour}" stroke-width="${stroke.width ?? 1.5}"` : "";
    this.parts.push(`<circle cx="${pixel(x)}" cy="${pixel(y)}" r="${pixel(radius)}" fill="${fill ?? "none"}"${line}/>`);
  }

  image(picture: HTMLCanvasElement, x: number, y: number, width: number, height: number): void {
    this.parts.push(`<image x="${pixel(x)}" y="${pixel(y)}" width="${pixel(width)}" height="${pixel(height)}" preserveAspectRatio="none" style="image-rendering:pixelated" href="${picture.toDataURL()}"/>`);
  }

  text(x: number, y: number, text: string, { colour, size = 12, anchor = "start", baseline = "middle", turned = false, weight = 400 }: TextStyle): void {
    const shift = { top: "0.8em", middle: "0.32em", bottom: "-0.2em" }[baseline];
    const turn = turned ? ` transform="rotate(-90 ${pixel(x)} ${pixel(y)})"` : "";
    this.parts.push(`<text x="${pixel(x)}" y="${pixel(y)}" dy="${shift}" font-size="${size}" font-weight="${weight}" text-anchor="${anchor}" fill="${colour}"${turn}>${escaped(text)}</text>`);
  }

  clipped(x: number, y: number, width: number, height: number, body: () => void): void {
    const name = `clip${++this.clips}`;
    this.parts.push(`<clipPath id="${name}"><rect x="${pixel(x)}" y="${pixel(y)}" width="${pixel(width)}" height="${pixel(height)}"/></clipPath><g clip-path="url(#${name})">`);
    body();
    this.parts.push("</g>");
  }

  /** The whole file. @param title  read by programs for people who do not see */
  file(width: number, height: number, title: string): string {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="${escaped(fontFamily).replaceAll('"', "'")}">\n<title>${escaped(title)}</title>\n${this.parts.join("\n")}\n</svg>\n`;
  }
}
