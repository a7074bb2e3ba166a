using FractalEngine.Core.Geometry;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>Draws lit, instanced triangles: chooses the program that a material needs, and says how it looks.</summary>
internal sealed class MeshPass(RenderContext context) : IDisposable
{
    /// <summary>Where the programs expect the object's block.</summary>
    public const int ObjectBinding = 0;

    /// <summary>Where the programs expect the lights.</summary>
    public const int LightBinding = 1;

    private static readonly Colour WireframeColour = new(0.80, 0.83, 0.87);

    // By features; each is built when it is needed first.
    private readonly MeshProgram?[] _programs = new MeshProgram?[32];

    // The frame for which each has the view.
    private readonly long[] _lastFrameOfProgram = new long[32];
    private long _frameNumber;
    private (View View, double Aspect, BoundingBox Bounds, bool Wireframe, Shading Shading)? _frameState;

    /// <summary>Begins a frame.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the viewport.</param>
    /// <param name="bounds">Of everything there is.</param>
    /// <param name="wireframe">Light grey lines instead of lit surfaces.</param>
    /// <param name="shading">Where the lights act.</param>
    public void Begin(View view, double aspect, BoundingBox bounds, bool wireframe, Shading shading)
    {
        _frameState = (view, aspect, bounds, wireframe, shading);
        _frameNumber++;
        GlShim.SetWireframe(wireframe);
    }

    /// <summary>Makes the program for a material current, and brings its uniforms up to date.</summary>
    /// <param name="material">Null for the object's own colour.</param>
    /// <param name="tint">Multiplies the material's colour, sRGB.</param>
    /// <param name="instanceFeatures">
    /// <see cref="MeshFeatures.CameraRelative"/> and <see cref="MeshFeatures.FrontFacesOnly"/>, where they hold.
    /// </param>
    /// <exception cref="InvalidOperationException">No frame was begun.</exception>
    /// <exception cref="GlException">The driver refuses the program.</exception>
    public void UseMaterial(DrawableMaterial? material, Colour tint, MeshFeatures instanceFeatures)
    {
        var (view, aspect, bounds, wireframe, shading) = _frameState ?? throw new InvalidOperationException("no frame was begun");
        var features = instanceFeatures | (wireframe ? MeshFeatures.None : FeaturesOf(material, shading));
        var program = _programs[(int)features] ??= new(context, features);
        program.Use();
        if (context.Resources.State.Filter.Update(ref _lastFrameOfProgram[(int)features], _frameNumber))
        {
            program.View.Set(view, aspect, bounds);
            program.SetWireframe(wireframe, WireframeColour);
        }

        // The object's own colour is not tinted: objects of different tints then share what is set.
        program.SetMaterial(material, material is null ? Colour.White : tint);
    }

    /// <summary>Chooses which side of the triangles is not drawn.</summary>
    /// <param name="culledFace">True for the front, false for the back; null to draw both.</param>
    public void Cull(bool? culledFace) => context.Resources.State.Cull(culledFace);

    /// <summary>From here on what is drawn mixes with what is there, and hides nothing. Colours come multiplied by their opacity.</summary>
    public static void BeginTransparent()
    {
        GL.Enable(EnableCap.Blend);
        GL.BlendFuncSeparate(BlendingFactorSrc.One, BlendingFactorDest.OneMinusSrcAlpha, BlendingFactorSrc.Zero, BlendingFactorDest.One);
        GL.DepthMask(false);
    }

    /// <summary>From here on what is drawn hides what lies behind.</summary>
    public static void EndTransparent()
    {
        GL.DepthMask(true);
        GL.Disable(EnableCap.Blend);
    }

    /// <summary>Leaves filled triangles with both sides for whoever draws next.</summary>
    public void End()
    {
        Cull(null);
        GlShim.SetWireframe(false);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        foreach (var program in _programs)
        {
            program?.Dispose();
        }
    }

    private static MeshFeatures FeaturesOf(DrawableMaterial? material, Shading shading) =>
        (shading == Shading.PerPixel ? MeshFeatures.PerPixel : 0)
        | (material?.Texture is not null ? MeshFeatures.Textured : 0)
        | (material?.Material.IsGlossy == true ? MeshFeatures.Glossy : 0);
}
