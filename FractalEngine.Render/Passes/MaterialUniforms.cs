using FractalEngine.Core.Geometry;
using FractalEngine.Render.Gl;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>A material as a shader sees it: <c>material</c> in material.glsl. Set when it has changed, not per draw call.</summary>
internal sealed class MaterialUniforms(ShaderProgram program, RedundancyFilter filter)
{
    private const int VectorCount = 4;

    // 0 to that power is not defined, and beyond the other end a highlight is smaller than any pixel.
    private const double MinSpecularExponent = 1;
    private const double MaxSpecularExponent = 10_000;

    private readonly int _location = program.UniformLocation("material");
    private readonly float[] _data = new float[4 * VectorCount];
    private (Material? Material, Colour Tint)? _lastKey;

    /// <summary>Sets what a surface looks like. The program must be in use.</summary>
    /// <param name="material">Null for the object's own colour, matt and opaque.</param>
    /// <param name="tint">Multiplies the material's colour, sRGB.</param>
    public void Set(Material? material, Colour tint)
    {
        if (!filter.ShouldPerform(_lastKey is { } last && ReferenceEquals(last.Material, material) && last.Tint == tint))
        {
            return;
        }

        _lastKey = (material, tint);
        var (diffuse, linearTint) = (ClampNegative(material?.Diffuse ?? Colour.White).ToLinear(), tint.ToLinear());
        Write(0, new(diffuse.Red * linearTint.Red, diffuse.Green * linearTint.Green, diffuse.Blue * linearTint.Blue), material?.Opacity
            ?? 1);
        Write(4, ClampNegative(material?.Specular ?? Colour.Black),
            Math.Clamp(material?.SpecularExponent ?? 1, MinSpecularExponent, MaxSpecularExponent));
        Write(8, ClampNegative(material?.Ambient ?? Colour.White), material is null ? 0 : 1);
        if (material?.Texture is { } texture)
        {
            (_data[12], _data[13]) = ((float)texture.Scale.U, (float)texture.Scale.V);
            (_data[14], _data[15]) = ((float)texture.Offset.U, (float)texture.Offset.V);
        }

        GL.Uniform4(_location, VectorCount, _data);
    }

    private static Colour ClampNegative(Colour colour) => new(Math.Max(colour.Red, 0), Math.Max(colour.Green, 0), Math.Max(colour.Blue, 0));

    private void Write(int start, Colour colour, double w) =>
        (_data[start], _data[start + 1], _data[start + 2], _data[start + 3]) =
        ((float)colour.Red, (float)colour.Green, (float)colour.Blue, (float)w);
}
