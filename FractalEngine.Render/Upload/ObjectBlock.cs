using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Lights;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Upload;

/// <summary>
/// The paper's matrix m of one object in a uniform buffer of its own (§4.3.1), with its colour; laid out as <c>ObjectBlock</c> in mesh.vert
/// (std140). The translation is relative to the camera, subtracted in double precision, so that objects far from the origin do not jitter.
/// </summary>
internal sealed class ObjectBlock(GlResources resources, string name) : IDisposable
{
    private readonly GlBuffer _buffer = new(resources, $"matrix of {name}", BufferTarget.UniformBuffer);
    private readonly float[] _data = new float[36];
    private (AffineMap ObjectToWorld, Colour Colour, Colour GradientEnd, Vector CameraPosition)? _lastKey;

    /// <summary>Binds the block, uploading it first where object or camera have moved.</summary>
    /// <param name="bindingPoint">Binding point of the program's block.</param>
    /// <param name="objectToWorld">Map from the frame of the drawn vertices to world space.</param>
    /// <param name="colour">Colour of the object, sRGB.</param>
    /// <param name="gradientEnd">Colour at the other end of a gradient, sRGB; the object's colour where there is none.</param>
    /// <param name="cameraPosition">Position of the camera in world space.</param>
    public void Bind(int bindingPoint, AffineMap objectToWorld, Colour colour, Colour gradientEnd, Vector cameraPosition)
    {
        if (resources.UploadFilter.Update(ref _lastKey, (objectToWorld, colour, gradientEnd, cameraPosition)))
        {
            WriteMatrix(objectToWorld.Linear, 0);
            WriteMatrix(NormalisedCofactors(objectToWorld.Linear), 12);
            LightBlock.WriteVector(objectToWorld.Translation - cameraPosition, 0, _data.AsSpan(24));
            LightBlock.WriteVector(colour.ToLinearVector(), 0, _data.AsSpan(28));
            LightBlock.WriteVector(gradientEnd.ToLinearVector(), 0, _data.AsSpan(32));
            _buffer.Upload<float>(_data, BufferUsageHint.DynamicDraw);
        }

        _buffer.BindTo(bindingPoint);
    }

    /// <inheritdoc/>
    public void Dispose() => _buffer.Dispose();

    /// <summary>
    /// Returns the cofactor matrix scaled to entries of at most 1. Only the direction of its products counts, and floats end at 1e38.
    /// </summary>
    private static Matrix NormalisedCofactors(Matrix linear)
    {
        var maxEntry = linear.MaxAbsEntry();
        var cofactors = maxEntry > 0 ? (linear / maxEntry).Cofactors() : linear;
        var maxCofactor = cofactors.MaxAbsEntry();
        return maxCofactor > 0 ? cofactors / maxCofactor : cofactors;
    }

    private void WriteMatrix(Matrix matrix, int start)
    {
        LightBlock.WriteVector(matrix.V1, 0, _data.AsSpan(start));
        LightBlock.WriteVector(matrix.V2, 0, _data.AsSpan(start + 4));
        LightBlock.WriteVector(matrix.V3, 0, _data.AsSpan(start + 8));
    }
}
