using FractalEngine.Core.Geometry;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>One combination of <see cref="MeshFeatures"/> as a program, with its uniforms.</summary>
internal sealed class MeshProgram : IDisposable
{
    private readonly RedundancyFilter _filter;
    private readonly ShaderProgram _program;
    private readonly int _flatColourLocation;
    private readonly MaterialUniforms _materialUniforms;
    private bool? _lastWireframe;

    /// <summary>Compiles and links it.</summary>
    public MeshProgram(RenderContext context, MeshFeatures features)
    {
        _filter = context.Resources.State.Filter;
        string[] symbols =
        [
            .. features.HasFlag(MeshFeatures.PerPixel) ? ["PER_PIXEL"] : Array.Empty<string>(),
            .. features.HasFlag(MeshFeatures.Textured) ? ["TEXTURED"] : Array.Empty<string>(),
            .. features.HasFlag(MeshFeatures.Glossy) ? ["GLOSSY"] : Array.Empty<string>(),
            .. features.HasFlag(MeshFeatures.CameraRelative) ? ["IN_WORLD"] : Array.Empty<string>(),
            .. features.HasFlag(MeshFeatures.FrontFacesOnly) ? ["FRONT_ONLY"] : Array.Empty<string>(),
        ];
        _program = ShaderProgram.Load(context.Resources, "mesh", symbols);
        _program.BindBlock("ObjectBlock", MeshPass.ObjectBinding);
        _program.BindBlock("LightBlock", MeshPass.LightBinding);
        View = new(_program, _filter, context.HasReversedDepth);
        _flatColourLocation = _program.UniformLocation("flatColour");
        _program.Use();
        GL.Uniform1(_program.UniformLocation("picture"), 0);
        _materialUniforms = new(_program, _filter);
    }

    /// <summary>The camera as this program sees it.</summary>
    public ViewUniforms View { get; }

    /// <summary>Makes it current.</summary>
    public void Use() => _program.Use();

    /// <summary>Sets the colour of lines, or that there are none. The program must be in use.</summary>
    public void SetWireframe(bool wireframe, Colour colour)
    {
        if (_filter.Update(ref _lastWireframe, wireframe))
        {
            var (red, green, blue) = colour.ToLinear();
            GL.Uniform4(_flatColourLocation, (float)red, (float)green, (float)blue, wireframe ? 1 : 0);
        }
    }

    /// <summary>Sets the material. The program must be in use.</summary>
    /// <param name="material">Null for the object's own colour.</param>
    /// <param name="tint">Multiplies the material's colours, sRGB.</param>
    public void SetMaterial(DrawableMaterial? material, Colour tint) => _materialUniforms.Set(material?.Material, tint);

    /// <inheritdoc/>
    public void Dispose() => _program.Dispose();
}
