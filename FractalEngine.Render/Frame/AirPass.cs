using FractalEngine.Core.Scenes;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>
/// Adds the light that haze scatters towards the eye to a drawn frame. At half its width and height, the way to each surface is followed
/// through the depth maps of the lights; neighbours before the same surface then share what they found.
/// </summary>
/// <remarks>The light and shadow blocks of the frame must be bound. Allocates nothing while the sizes stay the same.</remarks>
/// <param name="context">Current context.</param>
/// <param name="scene">Scene that declares lights.</param>
internal sealed class AirPass(RenderContext context, LoadedScene scene) : IDisposable
{
    private const MeshFeatures ShadowFeatures = MeshFeatures.Shadows | MeshFeatures.PointShadows | MeshFeatures.ShadowSlices;

    // The vertices have no attributes, but OpenGL requires an array.
    private readonly VertexArray _vertexArray = new(context.Resources, "air");
    private (MeshFeatures Features, int DistantLights, int Samples)? _lastKey;
    private AirProgram? _march;
    private AirProgram? _composition;
    private Framebuffer? _air;
    private Framebuffer? _colours;
    private DepthAtlas? _depths;

    /// <summary>Adds the light to what a framebuffer shows.</summary>
    /// <param name="frame">View of the frame.</param>
    /// <param name="target">Has the drawn frame, and is bound afterwards.</param>
    /// <param name="features">Features of all surfaces of the frame, of which shadows count.</param>
    /// <param name="distantLights">Lights with a position that are parallel in this frame: bit i for light i.</param>
    /// <exception cref="GlException">The driver refuses a program, or the GPU's memory does not suffice.</exception>
    public void Draw(in FrameView frame, Framebuffer target, MeshFeatures features, int distantLights)
    {
        BuildPrograms(features & ShadowFeatures, distantLights, target.Samples);
        Allocate(in frame, target);
        target.ResolveTo(_colours!);
        target.CopyDepthsTo(_depths!);
        _depths!.BindTexture(GlState.DepthTextureUnit);
        context.Resources.State.Cull(CullFace.None);
        GL.Disable(EnableCap.DepthTest);
        _vertexArray.Bind();

        _air!.Bind();
        Fill(_march!, in frame, target.Height);

        target.Bind();
        GL.Viewport(frame.X, target.Height - frame.Y - frame.Height, frame.Width, frame.Height);
        _air.Texture.BindTo(GlState.AirTextureUnit);
        _colours!.Texture.BindTo(GlState.FrameTextureUnit);
        Fill(_composition!, in frame, target.Height);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_vertexArray, _march, _composition, _air, _colours, _depths);

    private static void Fill(AirProgram program, in FrameView frame, int height)
    {
        program.Use(in frame, height);
        GL.DrawArrays(PrimitiveType.Triangles, 0, 3);
    }

    private void BuildPrograms(MeshFeatures features, int distantLights, int samples)
    {
        if (_lastKey == (features, distantLights, samples))
        {
            return;
        }

        GlObject.DisposeAll(_march, _composition);
        _march = null;
        _composition = null;
        string[] symbols = samples > 0 ? [FormattableString.Invariant($"SAMPLES {samples}")] : [];
        _march = new(
            context, "air.frag", [.. symbols, .. MeshProgram.SymbolsOf(features), .. LightBlock.SymbolsOf(scene, distantLights)]);
        _composition = new(context, "lit.frag", symbols);
        _lastKey = (features, distantLights, samples);
    }

    private void Allocate(in FrameView frame, Framebuffer target)
    {
        var (width, height) = ((frame.Width + 1) / 2, (frame.Height + 1) / 2);
        if (_depths is not null && (_depths.Width, _depths.Height, _depths.Samples) == (target.Width, target.Height, target.Samples)
            && (_air!.Width, _air.Height, _colours!.Format) == (width, height, target.Format))
        {
            return;
        }

        GlObject.DisposeAll(_air, _colours, _depths);
        // Stays null if one of the allocations fails.
        _depths = null;
        _air = new(context.Resources, "air", width, height, PixelInternalFormat.Rgba32f);
        _colours = new(context.Resources, "frame without air", target.Width, target.Height, target.Format);
        _depths = new(context.Resources, "depths of the frame", target.Width, target.Height, isFine: true, target.Samples);
    }

    /// <summary>A program that looks up the distances of the frame's surfaces: air.glsl.</summary>
    private sealed class AirProgram : ShaderProgram
    {
        private readonly ViewUniforms _view;

        /// <summary>Builds a program that fills the viewport.</summary>
        public AirProgram(RenderContext context, string file, IReadOnlyList<string> symbols)
            : base(context.Resources, ("image.vert", ShaderSource.Read("image.vert", [])), (file, ShaderSource.Read(file, symbols)))
        {
            BindBlock("LightBlock", GlState.LightBinding);
            if (symbols.Contains("SHADOWS"))
            {
                BindBlock("ShadowBlock", GlState.ShadowBinding);
            }

            _view = new(this, context.Resources.State.Filter, context.HasReversedDepth);
            Use();
            Set("shadowMap", GlState.ShadowTextureUnit);
            Set("air", GlState.AirTextureUnit);
            Set("depths", GlState.DepthTextureUnit);
            Set("frame", GlState.FrameTextureUnit);
        }

        /// <summary>Makes this the current program, for a frame of a given height.</summary>
        public void Use(in FrameView frame, int height)
        {
            Use();
            _view.Set(in frame);
            GL.Uniform4(UniformLocation("viewport"), frame.X, height - frame.Y - frame.Height, frame.Width, frame.Height);
        }
    }
}
