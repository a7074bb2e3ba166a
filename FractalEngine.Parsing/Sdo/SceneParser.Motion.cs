using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

/// <content>Parses how objects move by themselves: <c>moving velocity (…) spin (…) from (…) to (…)</c> and <c>belt (…)</c>.</content>
public sealed partial class SceneParser
{
    /// <summary>Parses a motion behind its keyword.</summary>
    private bool ParseMotion(Cursor cursor, Vector start, out ObjectMotion motion, out Cursor rest)
    {
        motion = new();
        rest = cursor;
        var hasVelocity = ParseKeyword(cursor, "velocity", out var velocityStart);
        if (hasVelocity)
        {
            if (!ParseVector(velocityStart, out var velocity, out rest))
            {
                return false;
            }

            motion = motion with { Velocity = velocity };
        }

        if (ParseNextKeyword(rest, "spin", hasVelocity, out var spinStart))
        {
            if (!ParseVector(spinStart, out var spin, out rest))
            {
                return false;
            }

            motion = motion with { Spin = spin };
        }
        else if (!hasVelocity)
        {
            return false;
        }

        return !hasVelocity || !ParseNextKeyword(rest, "from", true, out var fromStart)
            || ParsePath(fromStart, velocityStart, start, ref motion, out rest);
    }

    private bool ParsePath(Cursor cursor, Cursor velocityStart, Vector start, ref ObjectMotion motion, out Cursor rest)
    {
        if (!ParseVector(cursor, out var from, out rest) || !ParseBlanks(rest, out rest)
            || !ParseKeyword(rest, "to", out rest) || !ParseVector(rest, out var to, out rest))
        {
            return false;
        }

        motion = motion with { From = from, To = to };
        var fault = motion.FindFault(start);
        var isAboutVelocity = (motion with { Velocity = Vector.Zero }).FindFault(start) is null;
        Require(fault is null, isAboutVelocity ? velocityStart : cursor, fault ?? "");
        Require(motion.Velocity != Vector.Zero, velocityStart, "the velocity along a path must not be (0, 0, 0)");
        return true;
    }

    /// <summary>Parses a keyword that may follow a value; without it nothing is read.</summary>
    private bool ParseNextKeyword(Cursor cursor, string word, bool followsValue, out Cursor rest)
    {
        rest = cursor;
        return (!followsValue || (ParseBlanks(cursor, out rest) && rest.Offset > cursor.Offset)) && ParseKeyword(rest, word, out rest);
    }
}
