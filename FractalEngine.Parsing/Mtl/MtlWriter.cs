using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Mtl;

/// <summary>Writes Wavefront material files that <see cref="MtlParser"/> reads back to equal materials.</summary>
internal static class MtlWriter
{
    /// <summary>Returns the text of a material file.</summary>
    /// <param name="materials">Materials whose textures have full paths.</param>
    /// <param name="fullPath">Full path of the material file, to which the names of textures are relative.</param>
    /// <exception cref="FractalEngineException">The format can't express a number or a name.</exception>
    public static string Write(IEnumerable<Material> materials, string fullPath)
    {
        var text = new StringBuilder();
        foreach (var material in materials)
        {
            var isNameWritable = material.Name.Length > 0 && WritableNames.IsRestOfLine(material.Name);
            Require(isNameWritable, material, "its name is empty, or has a line break or a comment");
            text.Append(text.Length > 0 ? "\n" : "").Append("newmtl ").Append(material.Name).Append('\n');
            AppendSurface(text, material);
            foreach (var slot in TextureSlot.All)
            {
                AppendTexture(text, slot.Keywords[0], material, slot.Of(material), fullPath);
            }
        }

        return text.ToString();
    }

    /// <summary>Omits what has its default, as people do.</summary>
    private static void AppendSurface(StringBuilder text, Material material)
    {
        var defaults = new Material(material.Name);
        AppendColour(text, "Kd", material, material.Diffuse, defaults.Diffuse);
        AppendColour(text, "Ka", material, material.Ambient, defaults.Ambient);
        AppendColour(text, "Ks", material, material.Specular, defaults.Specular);
        AppendColour(text, "Ke", material, material.Emission, defaults.Emission);
        AppendNumber(text, "Ns", material, material.SpecularExponent, defaults.SpecularExponent);
        Require(material.Opacity is >= 0 and <= 1, material, "its opacity is not between 0 and 1");
        AppendNumber(text, "d", material, material.Opacity, defaults.Opacity);
        AppendNumber(text, "Ni", material, material.RefractiveIndex, defaults.RefractiveIndex);
        AppendColour(text, "Tf", material, material.Transmission, defaults.Transmission);
        AppendNumber(text, "Pr", material, material.Roughness);
        AppendNumber(text, "Pm", material, material.Metalness);
    }

    private static void AppendColour(StringBuilder text, string keyword, Material material, Colour colour, Colour defaultValue)
    {
        var isFinite = double.IsFinite(colour.Red) && double.IsFinite(colour.Green) && double.IsFinite(colour.Blue);
        Require(isFinite, material, $"a component of {keyword} is not finite");
        text.Append(colour == defaultValue
            ? ""
            : FormattableString.Invariant($"{keyword} {colour.Red:R} {colour.Green:R} {colour.Blue:R}\n"));
    }

    private static void AppendNumber(StringBuilder text, string keyword, Material material, double number, double defaultValue)
    {
        Require(double.IsFinite(number), material, $"{keyword} is not finite");
        text.Append(number.Equals(defaultValue) ? "" : FormattableString.Invariant($"{keyword} {number:R}\n"));
    }

    private static void AppendNumber(StringBuilder text, string keyword, Material material, double? number)
    {
        if (number is { } value)
        {
            AppendNumber(text, keyword, material, value, double.NaN);
        }
    }

    private static void AppendTexture(StringBuilder text, string keyword, Material material, MaterialTexture? texture, string fullPath)
    {
        // What is part of another file has no file that could be named.
        if (texture is null or { Contents.IsEmpty: false })
        {
            return;
        }

        var name = FileReference.Create(fullPath, texture.Path);
        // Backslashes are read as slashes, since programs on Windows write them.
        Require(WritableNames.IsRestOfLine(name) && !name.Contains('\\'), material, "the name of its texture can't be expressed");
        text.Append(keyword).Append(' ').Append(texture.IsClamped ? "-clamp on " : "");
        Require(double.IsFinite(texture.BumpFactor), material, "a number of -bm is not finite");
        text.Append(texture.BumpFactor.Equals(1) ? "" : FormattableString.Invariant($"-bm {texture.BumpFactor:R} "));
        // All three numbers are written, since a name may begin with a digit.
        AppendPair(text, "-s", material, texture.Scale, (1, 1), 1);
        AppendPair(text, "-o", material, texture.Offset, (0, 0), 0);
        text.Append(name.StartsWith('-') ? "./" : "").Append(name).Append('\n');
    }

    private static void AppendPair(
        StringBuilder text, string option, Material material, (double U, double V) pair, (double U, double V) defaultValue, double third)
    {
        Require(double.IsFinite(pair.U) && double.IsFinite(pair.V), material, $"a number of {option} is not finite");
        text.Append(pair == defaultValue ? "" : FormattableString.Invariant($"{option} {pair.U:R} {pair.V:R} {third} "));
    }

    private static void Require(bool condition, Material material, string fault)
    {
        if (!condition)
        {
            throw new FractalEngineException(
                $"the material '{WritableNames.Escape(material.Name)}' can't be written as a file: {fault}");
        }
    }
}
