using System.Globalization;
using System.Text;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>Writes OBJ files of a wavy square as other programs write them, in which every vertex is another.</summary>
/// <param name="Name">Name of the file in tables.</param>
/// <param name="Decimals">Digits behind the point; null for as many as tell the double, mostly 17.</param>
/// <param name="HasAttributes">Whether corners are <c>v/vt/vn</c> instead of <c>v</c>.</param>
/// <param name="HasQuads">Whether faces are quadrilaterals instead of triangles.</param>
internal sealed record ObjSample(string Name, int? Decimals, bool HasAttributes = false, bool HasQuads = false)
{
    /// <summary>The forms that most files have.</summary>
    public static IReadOnlyList<ObjSample> All { get; } =
    [
        new("v+f", 6), new("v/vt/vn", 6, HasAttributes: true), new("quads", 6, HasQuads: true), new("17 digits", null),
    ];

    /// <summary>Creates or replaces a file of this form.</summary>
    /// <param name="path">Path of the file.</param>
    /// <param name="side">Number of squares along each side.</param>
    public void Write(string path, int side)
    {
        using var writer = new StreamWriter(path, append: false, new UTF8Encoding(false), 1 << 20) { NewLine = "\n" };
        var random = new Random(1);
        for (var vertex = 0; vertex < (side + 1) * (side + 1); vertex++)
        {
            var (x, z) = ((vertex / (side + 1)) - (side / 2), (vertex % (side + 1)) - (side / 2));
            var height = Math.Sin(0.01 * x) * Math.Cos(0.01 * z);
            writer.WriteLine($"v {Format((0.0123 * x) + Noise())} {Format(height + Noise())} {Format((0.0123 * z) + Noise())}");
            if (HasAttributes)
            {
                writer.WriteLine($"vt {Format(random.NextDouble())} {Format(random.NextDouble())}");
                writer.WriteLine($"vn {Format(Noise())} {Format(1 - Noise())} {Format(-Noise())}");
            }
        }

        for (var square = 0; square < side * side; square++)
        {
            var a = (square / side * (side + 1)) + (square % side) + 1;
            var (b, c, d) = (a + 1, a + side + 2, a + side + 1);
            writer.WriteLine(HasQuads ? $"f {Corner(a)} {Corner(b)} {Corner(c)} {Corner(d)}" : $"f {Corner(a)} {Corner(b)} {Corner(c)}");
            if (!HasQuads)
            {
                writer.WriteLine($"f {Corner(a)} {Corner(c)} {Corner(d)}");
            }
        }

        double Noise() => 0.001 * random.NextDouble();
    }

    private string Corner(int index) => HasAttributes ? $"{index}/{index}/{index}" : $"{index}";

    private string Format(double number) =>
        number.ToString(Decimals is { } decimals ? $"F{decimals}" : "R", CultureInfo.InvariantCulture);
}
