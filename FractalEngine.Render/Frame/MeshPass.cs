using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>Selects the program that a material needs, and sets its uniforms, to draw lit, instanced triangles.</summary>
/// <param name="context">Current context.</param>
/// <param name="scene">Scene that declares lights, sky and probe.</param>
internal sealed class MeshPass(RenderContext context, LoadedScene scene) : IDisposable
{
    private static readonly Colour WireframeColour = new(0.80, 0.83, 0.87);

    private string[] _lightSymbols = LightBlock.SymbolsOf(scene);
    private int _distantLights;

    // Each program is built when it is first needed.
    private readonly Dictionary<MeshFeatures, MeshProgram> _programs = [];
    private long _frameNumber;
    private (FrameView Frame, bool Wireframe, MeshFeatures Features)? _frameState;

    /// <summary>The face of what is drawn next that lies inside a solid; none for open surfaces, which are hollow where cut.</summary>
    public CullFace InnerFace { get; set; }

    /// <summary>Begins drawing the meshes of a frame.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="wireframe">Whether light grey edges are drawn instead of lit surfaces.</param>
    /// <param name="features">Features of all surfaces of the frame, unless it shows edges.</param>
    /// <param name="distantLights">Lights with a position that are parallel in this frame: bit i for light i.</param>
    public void Begin(in FrameView frame, bool wireframe, MeshFeatures features, int distantLights)
    {
        SetDistantLights(distantLights);
        var section = frame.Section is null ? MeshFeatures.None : MeshFeatures.Section;
        _frameState = (frame, wireframe, section | (wireframe ? MeshFeatures.None : features));
        _frameNumber++;
        GlShim.SetWireframe(wireframe);
        if (frame.Section is not null)
        {
            GL.Enable(EnableCap.ClipDistance0);
        }
    }

    /// <summary>Makes the program for a material current, and sets its uniforms.</summary>
    /// <param name="material">Null for the object's own colour.</param>
    /// <param name="tint">Colour that multiplies the material's own, sRGB.</param>
    /// <param name="instanceFeatures">
    /// Those of <see cref="MeshFeatures.CameraRelative"/>, <see cref="MeshFeatures.FrontFacesOnly"/> and
    /// <see cref="MeshFeatures.VertexColours"/> that apply.
    /// </param>
    /// <param name="graded">Gradient that decides about the surface instead of a material; null for none.</param>
    /// <exception cref="InvalidOperationException">No frame was begun.</exception>
    /// <exception cref="GlException">The driver refuses the program.</exception>
    public void UseMaterial(DrawableMaterial? material, Colour tint, MeshFeatures instanceFeatures, Gradient? graded = null)
    {
        var (frame, wireframe, frameFeatures) = _frameState ?? throw new InvalidOperationException("no frame was begun");
        var features = instanceFeatures | frameFeatures | (wireframe ? MeshFeatures.None : FeaturesOf(material))
            | (graded is null ? 0 : MeshFeatures.Graded | (graded.IsGlossy ? MeshFeatures.Glossy : 0));
        if (!_programs.TryGetValue(features, out var program))
        {
            program = new(context, features, _lightSymbols);
            _programs.Add(features, program);
        }

        program.Use();
        if (program.BeginFrame(_frameNumber))
        {
            program.View.Set(in frame);
            program.SetWireframe(wireframe, WireframeColour);
            if (frame.Section is { } section)
            {
                program.SetSection(section);
            }
        }

        if (frame.Section is not null)
        {
            program.SetInnerFace(InnerFace);
        }

        if (graded is not null)
        {
            program.SetGradient(graded);
            return;
        }

        // The object's own colour is not tinted: objects with different tints then share the uniforms.
        program.SetMaterial(material, material is null ? Colour.White : tint);
    }

    /// <summary>Selects the face of triangles that is not drawn.</summary>
    public void Cull(CullFace face) => context.Resources.State.Cull(face);

    /// <summary>Blends what follows with the frame, without writing depth. Colours must be multiplied by their opacity.</summary>
    public static void BeginTransparent()
    {
        GlState.BeginBlending(BlendingFactorSrc.One);
        GL.DepthMask(false);
    }

    /// <summary>Ends blending and writes depth again.</summary>
    public static void EndTransparent()
    {
        GL.DepthMask(true);
        GL.Disable(EnableCap.Blend);
    }

    /// <summary>Restores filled triangles with both faces for the next pass.</summary>
    public void End()
    {
        Cull(CullFace.None);
        GlShim.SetWireframe(false);
        GL.Disable(EnableCap.ClipDistance0);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll([.. _programs.Values]);

    /// <summary>Programs know the kinds of shadows. These change when a view zooms away from a light, and hardly ever else.</summary>
    private void SetDistantLights(int distantLights)
    {
        if (_distantLights == distantLights)
        {
            return;
        }

        Dispose();
        _programs.Clear();
        _distantLights = distantLights;
        _lightSymbols = LightBlock.SymbolsOf(scene, distantLights);
    }

    private static MeshFeatures FeaturesOf(DrawableMaterial? material) =>
        (material?.Texture is not null ? MeshFeatures.Textured : 0)
        | (material?.Detail is not null ? MeshFeatures.Detailed : 0)
        | (material?.IsCutOut == true ? MeshFeatures.CutOut : 0)
        | (material is not null && material.Material.Emission != Colour.Black ? MeshFeatures.Emissive : 0)
        | (material?.Material.IsGlossy == true ? MeshFeatures.Glossy : 0);
}
