using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Gl;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>The camera as a shader sees it. Each uniform is set when it has changed, not per frame.</summary>
internal sealed class ViewUniforms(ShaderProgram program, RedundancyFilter filter, bool hasReversedDepth)
{
    private readonly int _cameraAxesLocation = program.UniformLocation("cameraAxes");
    private readonly int _viewScaleLocation = program.UniformLocation("viewScale");
    private readonly int _depthScaleLocation = program.UniformLocation("depthScale");
    private readonly float[] _rows = new float[9];
    private Matrix? _lastAxes;
    private (double X, double Y) _lastScale;
    private (double ZByDepth, double Z, double WByDepth, double W) _lastDepth;

    /// <summary>Sets what differs from the last call. The program must be in use.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the viewport.</param>
    /// <param name="bounds">Of everything there is, for planes that the view leaves open.</param>
    public void Set(View view, double aspect, BoundingBox bounds)
    {
        if (filter.Update(ref _lastAxes, view.Camera.LocalAxesInverse))
        {
            SetAxes(view.Camera.LocalAxesInverse);
        }

        var isPerspective = view.Projection == Projection.Perspective;
        var halfHeight = isPerspective ? view.Camera.HalfHeightAtUnitDepth : 0.5 * view.OrthographicHeight;
        var scale = (1 / (halfHeight * aspect), 1 / halfHeight);
        if (filter.Update(ref _lastScale, scale))
        {
            GL.Uniform2(_viewScaleLocation, (float)scale.Item1, (float)scale.Item2);
        }

        // Depth n goes to −1 and depth f to 1, or, reversed, n to 1 and f to 0: before the division by w = depth in perspective, directly
        // otherwise.
        var (near, far) = view.ClipPlanes(bounds);
        var depth = hasReversedDepth
            ? isPerspective
            ? (-near / (far - near), far * near / (far - near), 1.0, 0.0)
            : (-1 / (far - near), far / (far - near), 0.0, 1.0)
            : isPerspective
            ? ((far + near) / (far - near), -2 * far * near / (far - near), 1.0, 0.0)
            : (2 / (far - near), -(far + near) / (far - near), 0.0, 1.0);
        if (filter.Update(ref _lastDepth, depth))
        {
            GL.Uniform4(_depthScaleLocation, (float)depth.Item1, (float)depth.Item2, (float)depth.Item3, (float)depth.Item4);
        }
    }

    private void SetAxes(Matrix axes)
    {
        var (v1, v2, v3) = axes;
        (_rows[0], _rows[1], _rows[2]) = ((float)v1.X, (float)v2.X, (float)v3.X);
        (_rows[3], _rows[4], _rows[5]) = ((float)v1.Y, (float)v2.Y, (float)v3.Y);
        (_rows[6], _rows[7], _rows[8]) = ((float)v1.Z, (float)v2.Z, (float)v3.Z);
        GL.Uniform3(_cameraAxesLocation, 3, _rows);
    }
}
