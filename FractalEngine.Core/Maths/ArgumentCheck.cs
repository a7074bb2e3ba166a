using System.Diagnostics.CodeAnalysis;

namespace FractalEngine.Core.Maths;

/// <summary>Checks of what callers hand to the library.</summary>
internal static class ArgumentCheck
{
    /// <summary>Throws unless a requirement is met.</summary>
    /// <param name="isMet">Whether it is met.</param>
    /// <param name="requirement">What the exception says.</param>
    /// <param name="parameterName">Name of the caller's parameter; null where the message says enough.</param>
    /// <exception cref="ArgumentException">The requirement is not met.</exception>
    public static void Require([DoesNotReturnIf(false)] bool isMet, string requirement, string? parameterName = null)
    {
        if (!isMet)
        {
            throw new ArgumentException(requirement, parameterName);
        }
    }

    /// <summary>Throws for a value outside its range.</summary>
    /// <param name="isMet">Whether it is within.</param>
    /// <param name="value">The value, which the exception tells.</param>
    /// <param name="requirement">What the exception says.</param>
    /// <param name="parameterName">Name of the caller's parameter.</param>
    /// <exception cref="ArgumentOutOfRangeException">The requirement is not met.</exception>
    public static void RequireInRange<T>([DoesNotReturnIf(false)] bool isMet, T value, string requirement, string parameterName)
    {
        if (!isMet)
        {
            throw new ArgumentOutOfRangeException(parameterName, value, requirement);
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

    /// <summary>Throws for a placement that puts nothing anywhere or flattens it.</summary>
    /// <exception cref="ArgumentException">A component is not finite, or the matrix has no inverse.</exception>
    public static void RequirePlacement(Transformation placement, string parameterName)
    {
        Require(placement.IsFinite(), "expected a placement of finite numbers", parameterName);
        var volume = Math.Abs(placement.ToAffineMap().Linear.Determinant());
        Require(volume > 0 && double.IsFinite(volume), "expected a placement whose scale has an inverse", parameterName);
    }
}
