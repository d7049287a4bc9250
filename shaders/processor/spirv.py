# SPDX-License-Identifier: MIT
"""Reads a SPIR-V module into functions, blocks and constants, as far as translate needs it.

The numbers are those of the SPIR-V specification (Khronos, version 1.6): sections 3.49 for instructions, 3.20 for
decorations.
"""
import struct
from collections import defaultdict
from dataclasses import dataclass, field

# Instructions without a result.
PLAIN = {3: "Source", 4: "SourceExtension", 5: "Name", 6: "MemberName", 8: "Line", 14: "MemoryModel", 15: "EntryPoint",
         16: "ExecutionMode", 17: "Capability", 56: "FunctionEnd", 62: "Store", 71: "Decorate", 72: "MemberDecorate",
         246: "LoopMerge", 247: "SelectionMerge", 249: "Branch", 250: "BranchConditional", 251: "Switch", 253: "Return",
         254: "ReturnValue", 255: "Unreachable"}
# Instructions with a result that has no type.
UNTYPED = {7: "String", 11: "ExtInstImport", 19: "TypeVoid", 20: "TypeBool", 21: "TypeInt", 22: "TypeFloat",
           23: "TypeVector", 28: "TypeArray", 29: "TypeRuntimeArray", 30: "TypeStruct", 32: "TypePointer",
           33: "TypeFunction", 248: "Label"}
# Instructions with a typed result.
TYPED = {12: "ExtInst", 41: "ConstantTrue", 42: "ConstantFalse", 43: "Constant", 44: "ConstantComposite",
         50: "SpecConstant", 52: "SpecConstantOp", 54: "Function", 55: "FunctionParameter", 57: "FunctionCall",
         59: "Variable", 61: "Load", 65: "AccessChain", 79: "VectorShuffle", 80: "CompositeConstruct",
         81: "CompositeExtract", 109: "ConvertFToU", 110: "ConvertFToS", 111: "ConvertSToF", 112: "ConvertUToF",
         124: "Bitcast", 126: "SNegate", 127: "FNegate", 128: "IAdd", 129: "FAdd", 130: "ISub", 131: "FSub",
         132: "IMul", 133: "FMul", 134: "UDiv", 136: "FDiv", 137: "UMod", 142: "VectorTimesScalar",
         154: "Any", 155: "All", 164: "LogicalEqual", 165: "LogicalNotEqual", 166: "LogicalOr", 167: "LogicalAnd",
         168: "LogicalNot", 169: "Select", 170: "IEqual", 171: "INotEqual", 172: "UGreaterThan", 173: "SGreaterThan",
         174: "UGreaterThanEqual", 175: "SGreaterThanEqual", 176: "ULessThan", 177: "SLessThan",
         178: "ULessThanEqual", 179: "SLessThanEqual", 180: "FOrdEqual", 183: "FUnordNotEqual", 184: "FOrdLessThan",
         186: "FOrdGreaterThan", 188: "FOrdLessThanEqual", 190: "FOrdGreaterThanEqual", 194: "ShiftRightLogical",
         195: "ShiftRightArithmetic", 196: "ShiftLeftLogical", 197: "BitwiseOr", 198: "BitwiseXor", 199: "BitwiseAnd",
         200: "Not", 204: "BitReverse", 234: "AtomicIAdd", 245: "Phi", 400: "CopyLogical"}

SPEC_ID, ARRAY_STRIDE, BUILT_IN, BINDING, OFFSET = 1, 6, 11, 33, 35  # decorations
STORAGE_INPUT, STORAGE_FUNCTION, STORAGE_PUSH_CONSTANT = 1, 7, 9
WORKGROUP_ID, LOCAL_INVOCATION_INDEX = 26, 29  # built-in variables


class Unknown(Exception):
    """The module has something that the translation has no rule for."""


@dataclass
class Instruction:
    name: str
    type: int  # id, 0 without
    id: int  # 0 without
    operands: tuple


@dataclass
class Block:
    label: int
    instructions: list = field(default_factory=list)
    merge: int = 0  # where the two sides of its branch meet
    loop: tuple = ()  # of a loop's header: the label behind the loop, and that of its continue block
    end: Instruction = None

    def calls(self):
        return [i for i in self.instructions if i.name == "FunctionCall"]


@dataclass
class Function:
    id: int
    result: int  # type
    parameters: list = field(default_factory=list)
    variables: list = field(default_factory=list)
    blocks: dict = field(default_factory=dict)  # [label], the first one first


def text_of(words):
    return struct.pack(f"<{len(words)}I", *words).split(b"\0")[0].decode()


def instructions_of(words):
    at = 5  # behind the header
    while at < len(words):
        size, code = words[at] >> 16, words[at] & 0xFFFF
        operands = words[at + 1:at + size]
        at += size
        if code in PLAIN:
            yield Instruction(PLAIN[code], 0, 0, operands)
        elif code in UNTYPED:
            yield Instruction(UNTYPED[code], 0, operands[0], operands[1:])
        elif code in TYPED:
            yield Instruction(TYPED[code], operands[0], operands[1], operands[2:])
        else:
            raise Unknown(f"instruction {code} of SPIR-V")


class Module:
    """`known` has the bits that are known of specialization constants: {SpecId: (mask, value of those bits)}."""

    def __init__(self, data, known):
        self.types, self.constants, self.functions = {}, {}, {}
        self.names, self.member_names = {}, {}
        self.decorations, self.member_decorations = defaultdict(dict), defaultdict(dict)
        self.definitions = {}  # [id] of values and variables
        self.entry = 0
        function = block = None
        for i in instructions_of(struct.unpack(f"<{len(data) // 4}I", data)):
            if i.id and i.type:
                self.definitions[i.id] = i
            if i.name == "Name":
                self.names[i.operands[0]] = text_of(i.operands[1:])
            elif i.name == "MemberName":
                self.member_names[i.operands[:2]] = text_of(i.operands[2:])
            elif i.name == "Decorate":
                self.decorations[i.operands[0]][i.operands[1]] = (i.operands[2:] or (1,))[0]
            elif i.name == "MemberDecorate":
                self.member_decorations[i.operands[:2]][i.operands[2]] = (i.operands[3:] or (1,))[0]
            elif i.name == "EntryPoint":
                self.entry = i.operands[1]
            elif i.name.startswith("Type"):
                self.types[i.id] = i
            elif "Constant" in i.name:
                self.constants[i.id] = i
            elif i.name == "Function":
                function = self.functions[i.id] = Function(i.id, i.type)
            elif i.name == "FunctionParameter":
                function.parameters.append(i)
            elif i.name == "FunctionEnd":
                function = None
            elif function is None:
                pass  # variables of the module are in `definitions`
            elif i.name == "Label":
                block = function.blocks[i.id] = Block(i.id)
            elif i.name == "Variable":
                function.variables.append(i)
            elif i.name == "SelectionMerge":
                block.merge = i.operands[0]
            elif i.name == "LoopMerge":
                block.loop = i.operands[:2]
            elif i.name in ("Branch", "BranchConditional", "Switch", "Return", "ReturnValue", "Unreachable"):
                block.end = i
            elif i.name != "Line":
                block.instructions.append(i)
        self.values = {}  # [id] of constants that are known now
        for i in self.constants.values():
            value = self._value(i, known)
            if value is not None:
                self.values[i.id] = value

    def _value(self, i, known):
        if i.name in ("ConstantTrue", "ConstantFalse"):
            return i.name == "ConstantTrue"
        if i.name == "Constant":
            return i.operands[0]
        if i.name == "SpecConstant":
            mask, value = known.get(self.decorations[i.id][SPEC_ID], (0, 0))
            return value if mask == 0xFFFFFFFF else None
        if i.name != "SpecConstantOp":
            return None
        operation, *operands = i.operands
        values = [self.values.get(o) for o in operands]
        if TYPED[operation] == "BitwiseAnd" and None in values:
            # Some bits of a constant may be known.
            for constant, bits in (operands, operands[::-1]):
                definition = self.constants[constant]
                if definition.name == "SpecConstant" and bits in self.values:
                    mask, value = known.get(self.decorations[constant][SPEC_ID], (0, 0))
                    if self.values[bits] & ~mask == 0:
                        return value & self.values[bits]
        if None in values:
            return None
        evaluate = {"BitwiseAnd": lambda a, b: a & b, "IEqual": lambda a, b: a == b, "INotEqual": lambda a, b: a != b,
                    "LogicalAnd": lambda a, b: a and b, "LogicalOr": lambda a, b: a or b, "LogicalNot": lambda a: not a}
        return evaluate[TYPED[operation]](*values) if TYPED[operation] in evaluate else None

    def type_of(self, value):
        return self.types[self.definitions[value].type]

    def pointee(self, pointer):
        """Returns the id of the type that a pointer points to."""
        return self.type_of(pointer).operands[1]

    def element(self, type_id, index):
        """Returns the id of the type of an element."""
        t = self.types[type_id]
        return t.operands[index] if t.name == "TypeStruct" else t.operands[0]

    def path(self, pointer):
        """Returns the variable or parameter behind a pointer, and the ids of the indices into it."""
        i = self.definitions[pointer]
        if i.name != "AccessChain":
            return i, ()
        variable, indices = self.path(i.operands[0])
        return variable, indices + i.operands[1:]

    def is_local(self, pointer):
        variable, _ = self.path(pointer)
        return variable.name == "FunctionParameter" or variable.operands[0] == STORAGE_FUNCTION

    def successors(self, block):
        """Returns the labels that the execution may come to, without those that known constants rule out."""
        end = block.end
        if end.name == "Branch":
            return [end.operands[0]]
        if end.name == "BranchConditional":
            value = self.values.get(end.operands[0])
            return list(end.operands[1:3]) if value is None else [end.operands[1 if value else 2]]
        if end.name == "Switch":
            return [end.operands[1], *end.operands[3::2]]
        return []

    def reached(self, function):
        """Returns the blocks that the execution may come to, the first one first."""
        seen, todo = set(), [next(iter(function.blocks))]
        while todo:
            label = todo.pop()
            if label not in seen:
                seen.add(label)
                todo += self.successors(function.blocks[label])
        return [block for label, block in function.blocks.items() if label in seen]

    def called_first(self):
        """Returns the functions that the entry point needs, each behind those that it calls."""
        order = []
        seen = set()

        def visit(function):
            if function.id not in seen:
                seen.add(function.id)
                for block in self.reached(function):
                    for call in block.calls():
                        visit(self.functions[call.operands[0]])
                order.append(function)

        visit(self.functions[self.entry])
        return order


def dominators(module, function):
    """Returns for each label the labels that every way to it passes, itself among them."""
    before = defaultdict(list)
    blocks = module.reached(function)
    for block in blocks:
        for label in module.successors(block):
            before[label].append(block.label)
    labels = [block.label for block in blocks]
    result = {label: set(labels) for label in labels}
    result[labels[0]] = {labels[0]}
    is_changed = True
    while is_changed:
        is_changed = False
        for label in labels[1:]:
            ways = [result[b] for b in before[label]]
            now = set.intersection(*ways) | {label}
            if now != result[label]:
                result[label] = now
                is_changed = True
    return result
