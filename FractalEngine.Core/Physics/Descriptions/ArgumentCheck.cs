using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>Checks of what callers hand to the physics.</summary>
internal static class ArgumentCheck
{
    /// <summary>Throws unless a requirement is met.</summary>
    /// <param name="isMet">Whether it is met.</param>
    /// <param name="requirement">What the exception says.</param>
    /// <param name="subject">What the requirement is about, before a colon; null for no such prefix.</param>
    /// <param name="parameterName">Name of the caller's parameter; null where the message says enough.</param>
    /// <exception cref="ArgumentException">The requirement is not met.</exception>
    public static void Require(
        [DoesNotReturnIf(false)] bool isMet, string requirement, string? subject = null, string? parameterName = null)
    {
        if (!isMet)
        {
            throw new ArgumentException(subject is null ? requirement : $"{subject}: {requirement}", parameterName);
        }
    }

    /// <summary>Throws for a vector with a coordinate that is NaN or infinite.</summary>
    /// <param name="vector">What must be finite.</param>
    /// <param name="parameterName">Name of the caller's parameter.</param>
    /// <exception cref="ArgumentException">A coordinate is not finite.</exception>
    public static void RequireFinite(Vector vector, string parameterName)
    {
        if (!vector.IsFinite())
        {
            throw new ArgumentException($"expected a finite {parameterName}", parameterName);
        }
    }

    /// <summary>Throws for a layer that there is not.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The layer is not from 0 to 31.</exception>
    public static void RequireLayer(int layer, string parameterName)
    {
        if (layer is < 0 or >= Layers.Count)
        {
            throw new ArgumentOutOfRangeException(parameterName, layer, "expected a layer from 0 to 31");
        }
    }

    /// <summary>Throws for a time step that is not positive or not finite.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The time step is NaN, infinite, negative or zero.</exception>
    public static void RequireTimeStep(double seconds, string parameterName)
    {
        if (!(seconds > 0) || !double.IsFinite(seconds))
        {
            throw new ArgumentOutOfRangeException(parameterName, seconds, "expected a positive and finite time step");
        }
    }

    /// <summary>Throws for a placement that puts nothing anywhere or flattens it.</summary>
    /// <exception cref="ArgumentException">A component is not finite, or the matrix has no inverse.</exception>
    public static void RequirePlacement(Transformation placement, string parameterName)
    {
        Require(placement.IsFinite(), "expected a placement of finite numbers", null, parameterName);
        var volume = Math.Abs(placement.ToAffineMap().Linear.Determinant());
        Require(volume > 0 && double.IsFinite(volume), "expected a placement whose scale has an inverse", null, parameterName);
    }
}
