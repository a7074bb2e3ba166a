using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>
/// What is seen from a point to all sides: a cube of linear light before exposure and tone, times what objects cover of each texel, with
/// their depths. Its further levels are means, for rougher surfaces. 5 MB.
/// </summary>
internal sealed class ReflectionProbe : GlObject
{
    /// <summary>Number of sides of the cube.</summary>
    public const int SideCount = 6;

    private const int Size = 256;
    private const double NearToFarRatio = 1e-5;

    // In the order of OpenGL: what each side looks at, and what is up there. Seen from within, all of them are mirror images.
    private static readonly (Vector Forward, Vector Up)[] Sides =
    [
        (Vector.I, -Vector.J), (-Vector.I, -Vector.J), (Vector.J, Vector.K), (-Vector.J, -Vector.K), (Vector.K, -Vector.J),
        (-Vector.K, -Vector.J),
    ];

    private readonly bool _hasReversedDepth;
    private readonly Vector _position;
    private readonly int _framebuffer = GL.GenFramebuffer();
    private readonly int _colours;
    private readonly int _depths;
    private (bool Shadows, bool Occlusion, Shading Shading)? _drawnStyle;
    private (double Near, double Far) _planes;

    /// <summary>Allocates a cube that has not been drawn yet.</summary>
    /// <param name="context">Current context.</param>
    /// <param name="position">World space.</param>
    /// <exception cref="GlException">The GPU's memory does not suffice.</exception>
    public ReflectionProbe(RenderContext context, Vector position)
        : base(context.Resources, "reflection probe")
    {
        _hasReversedDepth = context.HasReversedDepth;
        _position = position;
        GL.Enable(EnableCap.TextureCubeMapSeamless);
        _colours = Allocate(PixelInternalFormat.Rgba16f, PixelFormat.Rgba, TextureMinFilter.LinearMipmapLinear, TextureMagFilter.Linear);
        _depths = Allocate(
            PixelInternalFormat.DepthComponent32f, PixelFormat.DepthComponent, TextureMinFilter.Nearest, TextureMagFilter.Nearest);
        DisposeOnFailure(this, () => Resources.ThrowOnError($"{this} of {Size}×{Size} texels a side"));
    }

    /// <summary>What shaders know of it; null while mirrors must not show it.</summary>
    public ProbePlace? Place => _drawnStyle is null ? null
        : _hasReversedDepth ? new(_position, 1 / _planes.Far, 1 / _planes.Near) : new(_position, 1 / _planes.Near, 1 / _planes.Far);

    /// <summary>Notes that the scene has changed.</summary>
    public void Forget() => _drawnStyle = null;

    /// <summary>Whether it shows the scene in the style of a frame.</summary>
    public bool Shows(RenderSettings settings) => _drawnStyle == StyleOf(settings);

    /// <summary>Returns the view of one side.</summary>
    /// <param name="side">From 0 to 5.</param>
    /// <param name="bounds">Bounds of the scene, world space.</param>
    public FrameView ViewOf(int side, BoundingBox bounds)
    {
        var far = Math.Max(1.01 * ((bounds.Centre - _position).Length() + (0.5 * bounds.FiniteDiagonalOr(1000))), 1e-30);
        _planes = (NearToFarRatio * far, far);
        var camera = CameraFraming.LookAt(Vector.Zero, Sides[side].Forward, Sides[side].Up, 90, Handedness.Right);
        var view = new View(camera with { Position = _position }, Projection.Perspective);
        return FrameView.Create(view, Size, Size, _planes) with { IsProbe = true };
    }

    /// <summary>Makes a side the framebuffer that is drawn into. Until <see cref="End"/>, mirrors don't show the probe.</summary>
    public void Bind(int side)
    {
        Forget();
        GlState.BindTexture(GlState.ProbeTextureUnit, 0, TextureTarget.TextureCubeMap);
        GlState.BindTexture(GlState.ProbeDepthTextureUnit, 0, TextureTarget.TextureCubeMap);
        GL.BindFramebuffer(FramebufferTarget.Framebuffer, _framebuffer);
        Attach(FramebufferAttachment.ColorAttachment0, _colours);
        Attach(FramebufferAttachment.DepthAttachment, _depths);

        void Attach(FramebufferAttachment attachment, int texture) => GL.FramebufferTexture2D(
            FramebufferTarget.Framebuffer, attachment, TextureTarget.TextureCubeMapPositiveX + side, texture, 0);
    }

    /// <summary>Computes the further levels, once all sides are drawn, and shows the probe from now on.</summary>
    /// <param name="settings">Style of the sides.</param>
    public void End(RenderSettings settings)
    {
        BindTextures();
        GL.ActiveTexture(TextureUnit.Texture0 + GlState.ProbeTextureUnit);
        GL.GenerateMipmap(GenerateMipmapTarget.TextureCubeMap);
        GL.ActiveTexture(TextureUnit.Texture0);
        _drawnStyle = StyleOf(settings);
    }

    /// <summary>Binds colours and depths to their units.</summary>
    public void BindTextures()
    {
        GlState.BindTexture(GlState.ProbeTextureUnit, _colours, TextureTarget.TextureCubeMap);
        GlState.BindTexture(GlState.ProbeDepthTextureUnit, _depths, TextureTarget.TextureCubeMap);
    }

    /// <inheritdoc/>
    protected internal override void Delete()
    {
        GL.DeleteFramebuffer(_framebuffer);
        Resources.State.DeleteTexture(_colours);
        Resources.State.DeleteTexture(_depths);
    }

    private static (bool Shadows, bool Occlusion, Shading Shading) StyleOf(RenderSettings settings) =>
        (settings.Shadows, settings.AmbientOcclusion, settings.Shading);

    private static int Allocate(PixelInternalFormat format, PixelFormat components, TextureMinFilter minFilter, TextureMagFilter magFilter)
    {
        var name = GL.GenTexture();
        GlState.BindTexture(GlState.ProbeTextureUnit, name, TextureTarget.TextureCubeMap);
        GL.ActiveTexture(TextureUnit.Texture0 + GlState.ProbeTextureUnit);
        for (var side = TextureTarget.TextureCubeMapPositiveX; side <= TextureTarget.TextureCubeMapNegativeZ; side++)
        {
            GL.TexImage2D(side, 0, format, Size, Size, 0, components, PixelType.Float, IntPtr.Zero);
        }

        GL.TexParameter(TextureTarget.TextureCubeMap, TextureParameterName.TextureMinFilter, (int)minFilter);
        GL.TexParameter(TextureTarget.TextureCubeMap, TextureParameterName.TextureMagFilter, (int)magFilter);
        GL.ActiveTexture(TextureUnit.Texture0);
        return name;
    }
}
