using FractalEngine.Core.Geometry;
using FractalEngine.Render.Gl;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>A material as a shader sees it: <c>material</c> in material.glsl. Set when it has changed, not per draw call.</summary>
internal sealed class MaterialUniforms(ShaderProgram program, ChangeCounter changes)
{
    private const int Vectors = 4;

    // 0 to that power is not defined, and beyond the other end a highlight is smaller than any pixel.
    private const double SmallestExponent = 1;
    private const double LargestExponent = 10_000;

    private readonly int _location = program.Uniform("material");
    private readonly float[] _data = new float[4 * Vectors];
    private (Material? Material, Colour Tint)? _last;

    /// <summary>Sets what a surface looks like. The program must be in use.</summary>
    /// <param name="material">Null for the object's own colour, matt and opaque.</param>
    /// <param name="tint">Multiplies the material's colour, sRGB.</param>
    public void Set(Material? material, Colour tint)
    {
        if (!changes.IsNeeded(_last is { } last && ReferenceEquals(last.Material, material) && last.Tint == tint))
        {
            return;
        }

        _last = (material, tint);
        var (diffuse, factor) = (NotNegative(material?.Diffuse ?? Colour.White).ToLinear(), tint.ToLinear());
        Write(0, new(diffuse.Red * factor.Red, diffuse.Green * factor.Green, diffuse.Blue * factor.Blue), material?.Opacity ?? 1);
        Write(4, NotNegative(material?.Specular ?? Colour.Black), Math.Clamp(material?.SpecularExponent ?? 1, SmallestExponent, LargestExponent));
        Write(8, NotNegative(material?.Ambient ?? Colour.White), material is null ? 0 : 1);
        if (material?.Texture is { } texture)
        {
            (_data[12], _data[13]) = ((float)texture.Scale.U, (float)texture.Scale.V);
            (_data[14], _data[15]) = ((float)texture.Offset.U, (float)texture.Offset.V);
        }

        GL.Uniform4(_location, Vectors, _data);
    }

    private static Colour NotNegative(Colour colour) => new(Math.Max(colour.Red, 0), Math.Max(colour.Green, 0), Math.Max(colour.Blue, 0));

    private void Write(int start, Colour colour, double fourth) =>
        (_data[start], _data[start + 1], _data[start + 2], _data[start + 3]) = ((float)colour.Red, (float)colour.Green, (float)colour.Blue, (float)fourth);
}
