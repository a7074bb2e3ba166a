using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Upload;

/// <summary>
/// Sets a material as the uniform <c>material</c> of material.glsl, where it differs from the last one of the program.
/// </summary>
internal sealed class MaterialUniforms(ShaderProgram program, RedundancyFilter filter)
{
    private const int VectorCount = 8;

    private readonly float[] _data = new float[4 * VectorCount];
    private readonly Dictionary<Material, Gloss?> _gloss = new(ReferenceEqualityComparer.Instance);
    private (Material? Material, Colour Tint)? _lastKey;

    /// <summary>Sets the material of the next draw calls. The program must be in use.</summary>
    /// <param name="material">Null for the object's own colour, matt and opaque.</param>
    /// <param name="tint">Colour that multiplies the material's own, sRGB.</param>
    public void Set(Material? material, Colour tint)
    {
        if (!filter.ShouldPerform(_lastKey is { } last && ReferenceEquals(last.Material, material) && last.Tint == tint))
        {
            return;
        }

        _lastKey = (material, tint);
        var diffuse = ClampNegative(material?.Diffuse ?? Colour.White).ToLinearVector();
        var gloss = GlossOf(material);
        LightBlock.WriteVector(tint.ToLinearVector().Stretch(diffuse), material?.Opacity ?? 1, _data);
        LightBlock.WriteVector(gloss?.Coat ?? default, gloss?.Roughness ?? 1, _data.AsSpan(4));
        WriteVector(8, ClampNegative(material?.Ambient ?? Colour.White), material is null ? 0 : 1);
        if (material?.Texture is { } texture)
        {
            LightBlock.WriteVector(new(texture.Scale.U, texture.Scale.V, texture.Offset.U), texture.Offset.V, _data.AsSpan(12));
        }

        WriteVector(16, ClampNegative(material?.Emission ?? Colour.Black), gloss?.Metalness ?? 0);
        LightBlock.WriteVector(gloss?.CoatOfSeveral ?? default, gloss?.RestOfFacets ?? 1, _data.AsSpan(20));
        var detail = material?.DetailTexture;
        var bumpFactor = material?.NormalTexture is null ? detail?.BumpFactor ?? 0 : 0;
        LightBlock.WriteVector(gloss?.RestOfCoat ?? Vector.One, bumpFactor, _data.AsSpan(24));
        if (detail is not null)
        {
            LightBlock.WriteVector(new(detail.Scale.U, detail.Scale.V, detail.Offset.U), detail.Offset.V, _data.AsSpan(28));
        }

        GL.Uniform4(program.UniformLocation("material"), VectorCount, _data);
    }

    private Gloss? GlossOf(Material? material)
    {
        if (material is null)
        {
            return null;
        }

        return _gloss.TryGetValue(material, out var known) ? known : _gloss[material] = Gloss.Of(material);
    }

    private static Colour ClampNegative(Colour colour) => new(Math.Max(colour.Red, 0), Math.Max(colour.Green, 0), Math.Max(colour.Blue, 0));

    private void WriteVector(int start, Colour colour, double w) =>
        LightBlock.WriteVector(new(colour.Red, colour.Green, colour.Blue), w, _data.AsSpan(start));
}
